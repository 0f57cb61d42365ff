"""Length units by their names, and those that files name."""

import gzip
import os
import struct
from typing import Optional, Union

METRES = {
    "m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "\N{MICRO SIGN}m": 1e-6, "nm": 1e-9, "km": 1e3,
    "in": 0.0254, "ft": 0.3048,
}


def metres(unit: Union[str, float]) -> float:
    """The length of a unit [m], of one of METRES or of a length already. Raises ValueError."""
    if isinstance(unit, str):
        if unit not in METRES:
            raise ValueError(f"unit is {unit!r}; give one of {', '.join(METRES)}, or its metres.")
        return METRES[unit]
    if not 1e-100 <= unit <= 1e100:
        raise ValueError(f"unit is {unit}; its metres must be finite and above 0.")
    return float(unit)


def file_unit(path: str) -> Optional[str]:
    """The length unit that a file names, or its format fixes, as one of METRES; None where neither
    does: glTF is in metres, DICOM and GIfTI in millimetres, NIfTI has a code."""
    lower = path.lower()
    if os.path.isdir(path) or lower.endswith((".gii", ".gii.gz")):
        return "mm"
    if lower.endswith((".glb", ".gltf", ".glb.gz", ".gltf.gz")):
        return "m"
    return _nifti_unit(path) if lower.endswith((".nii", ".nii.gz")) else None


def _nifti_unit(path):
    with gzip.open(path) if path.lower().endswith(".gz") else open(path, "rb") as file:
        header = file.read(540)
    # xyzt_units: a byte of NIfTI-1, whose header has 348 bytes, an int of NIfTI-2 with 540.
    for order in "<>" if len(header) >= 348 else "":
        size = struct.unpack_from(order + "i", header)[0]
        if size == 348 or size == len(header) == 540:
            code = header[123] if size == 348 else struct.unpack_from(order + "i", header, 500)[0]
            return {1: "m", 2: "mm", 3: "um"}.get(code & 7)
    return None
