"""Writes files whole or not at all, and never over what was read. Scripts without a build import it, too:
VTK is needed for surfaces and pictures alone.

A file without a name is written in the folder of its own, and named once it is whole, so that its name
has the old file or the new one, whatever ends the program. (Where the file system has no files without
names, a hidden one is renamed; SIGKILL then leaves that.) Links are followed; mode and owner are those
of the file that is replaced, or go by the umask. What fails is an OutputError that says what, where and
what to do, and leaves no remains.
"""

import contextlib
import errno
import itertools
import os
import re
import stat

_count = itertools.count()
_LONGEST_BASE = 200  # with what is added a name may have 255 bytes


class OutputError(OSError):
    """The message says what could not be written, where, and what to do."""


def _failure(path, error):
    """The OutputError for an OSError."""
    cause = error.strerror or str(error)
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        advice = "Free some space there, or choose a file on another disk."
    elif error.errno == errno.EFBIG:
        advice = "Raise the limit on the size of files (ulimit -f), or choose another file system."
    elif error.errno in (errno.ENOENT, errno.ENOTDIR):
        advice = "Make its folder first, or choose another one."
    elif error.errno in (errno.EISDIR, errno.EINVAL, errno.ENAMETOOLONG):
        advice = "Choose another name."
    else:
        advice = "Choose a folder that you may write to."
    return OutputError(f"{path}: could not be written: {cause}. {advice}")


def _target(path):
    """Where a file goes, links followed, and its status, None where there is none. Raises OSError
    where it cannot go there."""
    target = os.path.realpath(path)
    folder = os.path.dirname(target)
    try:
        status = os.stat(target)
    except FileNotFoundError:
        status = None
    if not os.fspath(path):
        raise OSError(errno.ENOENT, "no name is given")
    if os.path.islink(target):
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    if status and stat.S_ISDIR(status.st_mode):
        raise OSError(errno.EISDIR, "it is a folder")
    if status and not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "it is no regular file")
    if not os.path.isdir(folder):
        raise OSError(errno.ENOENT, f"there is no folder {folder}")
    if not os.access(folder, os.W_OK) or (status and not os.access(target, os.W_OK)):
        raise OSError(errno.EACCES, "no permission")
    return target, status


def files_of(path):
    """The files that reading a surface from `path` reads: itself, those in a folder, or the pieces
    that a .vtm or .gltf names."""
    if os.path.isdir(path):
        return [entry.path for entry in os.scandir(path) if entry.is_file()]
    files = [path]
    if os.fspath(path).lower().endswith((".vtm", ".gltf")) and os.path.isfile(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            names = re.findall(r"""(?:file|"uri")\s*[=:]\s*["']([^"'\r\n]+)["']""", file.read())
        files += [os.path.join(os.path.dirname(path), name) for name in names]
    return files


def check_outputs(outputs, inputs=()):
    """Raises OutputError where one of the files cannot be written, is one of the inputs by whatever
    name or link, or is another one of the outputs. For the beginning, before work would be lost."""
    read = [file for path in inputs for file in files_of(path) if os.path.exists(file)]
    written = {}
    for path in outputs:
        try:
            target, status = _target(path)
        except OSError as error:
            raise _failure(path, error) from error
        if status:
            for file in read:
                if os.path.samestat(status, os.stat(file)):
                    same = "" if os.fspath(file) == os.fspath(path) else f" {file}"
                    raise OutputError(
                        f"{path}: is what is read{same}, and would be destroyed. Give another name."
                    )
        if target in written:
            raise OutputError(
                f"{path}: is the same file as {written[target]}, which is written as well. Give "
                "another name."
            )
        written[target] = path


def _open_without_name(folder, mode):
    """A handle to write to a file that nothing names yet, or None where the system has no such files."""
    if not hasattr(os, "O_TMPFILE") or not os.path.isdir("/proc/self/fd"):
        return None
    try:
        return os.open(folder, os.O_WRONLY | os.O_TMPFILE, mode)
    except OSError as error:
        if error.errno in (errno.EOPNOTSUPP, errno.EISDIR, errno.EINVAL, errno.ENOENT):
            return None
        raise


@contextlib.contextmanager
def whole_file(path, inputs=(), text=False):
    """A binary (or text) file to write to, which becomes `path` at the end of the block.

    Raises OutputError where it cannot be written or is one of the inputs; the file that was there
    then stays as it was, as it does where the block raises anything."""
    check_outputs([path], inputs)
    partial = None
    try:
        target, status = _target(path)
        folder, base = os.path.split(target)
        name = os.fsdecode(os.fsencode(base)[:_LONGEST_BASE])
        while True:  # what a process of the same number may have left is not taken
            hidden = os.path.join(folder, f".{name}.{os.getpid()}-{next(_count)}.part")
            if not os.path.lexists(hidden):
                break
        mode = stat.S_IMODE(status.st_mode) & 0o777 if status else 0o666
        handle = _open_without_name(folder, mode)
        if handle is None:
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0)
            handle = os.open(hidden, flags, mode)
            partial = hidden
        with open(handle, "w" if text else "wb", newline="" if text else None,
                  encoding="utf-8" if text else None) as file:
            if status:
                with contextlib.suppress(PermissionError):  # only root can give a file away
                    os.fchown(handle, status.st_uid, status.st_gid)
                os.fchmod(handle, stat.S_IMODE(status.st_mode))
            yield file
            file.flush()
            os.fsync(handle)
            if not partial:
                # Python follows the link, which alone names the file, only where a folder is given.
                os.link(f"/proc/self/fd/{handle}", hidden, src_dir_fd=handle)
                partial = hidden
        os.replace(partial, target)
        partial = None
    except OutputError:
        raise
    except OSError as error:
        raise _failure(path, error) from error
    finally:
        if partial:
            with contextlib.suppress(FileNotFoundError):
                os.remove(partial)


def write_bytes(path, content, inputs=()):
    """Writes a file with these bytes."""
    with whole_file(path, inputs) as file:
        file.write(content)


def polydata_bytes(data):
    """A vtkPolyData as a .vtp file. Made in memory: VTK's writers end the process on a full disk."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetDataModeToBinary()  # see surfaces.py: not every VTK reads appended data
    # Four times as fast as zlib, at a sixth more bytes: a window that is closed writes before it ends.
    writer.SetCompressorTypeToLZ4()
    writer.WriteToOutputStringOn()
    if not writer.Write():
        raise OutputError("VTK could not turn the data into a .vtp file. Is there memory for it?")
    return writer.GetOutputString().encode()


def png_bytes(image):
    """A vtkImageData as a PNG file."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGWriter

    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.WriteToMemoryOn()
    writer.Write()
    result = writer.GetResult()
    if result is None or result.GetNumberOfTuples() == 0:
        raise OutputError("VTK could not turn the picture into a PNG file.")
    return vtk_to_numpy(result).tobytes()


def write_polydata(path, data, inputs=()):
    """Writes a vtkPolyData as .vtp."""
    write_bytes(path, polydata_bytes(data), inputs)


def write_png(path, image, inputs=()):
    """Writes a vtkImageData as PNG."""
    write_bytes(path, png_bytes(image), inputs)


def text_cell(text):
    """A name or label for a CSV file: a spreadsheet would run what begins as a formula does, so an
    apostrophe goes before it, which marks it as text there."""
    return "'" + text if text.startswith(("=", "+", "-", "@", "\t", "\r")) else text
