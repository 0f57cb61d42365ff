"""Colours surfaces by their data arrays, with a scale beside."""

from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor

from .surfaces import default_array, value_arrays

TEXT = (0.18, 0.21, 0.27)
# Dark blue over green to yellow: even steps for the eye, readable without colours.
VALUE_COLORS = (
    (0.27, 0.00, 0.33),
    (0.25, 0.27, 0.53),
    (0.16, 0.47, 0.56),
    (0.13, 0.66, 0.52),
    (0.48, 0.82, 0.32),
    (0.99, 0.91, 0.14),
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
    table = _value_colors(*array.GetRange(0))
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    return name, table


def other_arrays(surface, name):
    """The arrays that a surface could be coloured by besides."""
    return [other for other in value_arrays(surface) if other != name]


def scalar_bar(table, name, size):
    """The scale of a lookup table, at the right of a picture of this size [pixel]."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(name)
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetBarRatio(0.2)
    bar.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
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


def _value_colors(low, high):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetTableRange(low, high if high > low else low + 1.0)
    table.SetNanColor(0.6, 0.6, 0.6, 1.0)
    table.Build()
    for i in range(256):
        x = i / 255.0 * (len(VALUE_COLORS) - 1)
        k = min(int(x), len(VALUE_COLORS) - 2)
        below, above = VALUE_COLORS[k], VALUE_COLORS[k + 1]
        table.SetTableValue(i, *(a + (x - k) * (b - a) for a, b in zip(below, above)), 1.0)
    return table
