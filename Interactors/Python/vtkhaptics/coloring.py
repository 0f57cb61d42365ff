"""Colours surfaces by their data arrays, with a scale bar."""

from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from .classes import CLASSES
from .surfaces import default_array, value_arrays

LABELS = 4  # of a scale
TEXT = (0.18, 0.21, 0.27)
# Dark blue over green to yellow: even steps for the eye, readable without colours.
VALUE_COLORS = (
    (0.0, (0.27, 0.00, 0.33)),
    (0.2, (0.25, 0.27, 0.53)),
    (0.4, (0.16, 0.47, 0.56)),
    (0.6, (0.13, 0.66, 0.52)),
    (0.8, (0.48, 0.82, 0.32)),
    (1.0, (0.99, 0.91, 0.14)),
)


def color_by(actor, surface, wanted):
    """Colours an actor by an array: the wanted one, or where that is None the surface's default.

    Returns its name and lookup table; (None, None) where the surface has no such array, and no
    table where the array holds colours already.
    """
    points, cells = surface.GetPointData(), surface.GetCellData()
    name = wanted or default_array(surface)
    array = points.GetArray(name) or cells.GetArray(name) if name else None
    if not array:
        return None, None
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    if points.HasArray(name):
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(name)
    if array.GetDataTypeAsString() == "unsigned char" and array.GetNumberOfComponents() > 2:
        return name, None
    table = value_colors(*array.GetRange(0))
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    return name, table


def other_arrays(surface, name):
    """The arrays that a surface could be coloured by besides."""
    return [other for other in value_arrays(surface) if other != name]


def scalar_bar(table, name, size=None):
    """The scale of a table of colours, at the right of a picture of this size [pixel]; of a size that
    changes with the picture's where that is None."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(name)
    bar.SetNumberOfLabels(LABELS)
    bar.SetCustomLabels(_labels(*table.GetRange()))
    bar.UseCustomLabelsOn()
    bar.SetLabelFormat("%.3g")
    bar.SetVerticalTitleSeparation(8)
    bar.UnconstrainedFontSizeOn()
    bar.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    if size is None:
        bar.SetMaximumWidthInPixels(70)
        bar.SetMaximumHeightInPixels(260)
        bar.SetPosition(0.925, 0.05)
    else:
        bar.SetBarRatio(0.2)
        width, height = (min(1.0, p / all_) for p, all_ in zip((100, 280), size))
        bar.SetWidth(width)
        bar.SetHeight(min(height, 0.6))
        bar.SetPosition(1.0 - width, 0.05)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(*TEXT)
        text.SetFontSize(15)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar


def _labels(low, high):
    """The values that are written at a scale, where rounding would leave -5.6e-17 of zero."""
    labels = vtkDoubleArray()
    for i in range(LABELS):
        value = low + i / (LABELS - 1) * (high - low)
        labels.InsertNextValue(value if abs(value) > 1e-9 * max(abs(low), abs(high)) else 0.0)
    return labels


def force_colors(strongest):
    """The transfer function from forces, 0 to the strongest [N], to the colours that the hand has."""
    actor = CLASSES["vtkGodObjectActor"]()
    actor.SetReferenceForce(max(strongest, 1e-12))
    return actor.GetForceColors()


def value_colors(low, high):
    """The transfer function from values, low to high, to colours."""
    ramp = vtkColorTransferFunction()
    ramp.SetNanColor(0.6, 0.6, 0.6)
    width = high - low if high > low else 1.0
    for share, color in VALUE_COLORS:
        ramp.AddRGBPoint(low + share * width, *color)
    return ramp
