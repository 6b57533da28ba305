#!/usr/bin/python3
"""The last frame of a vtp export as ParaView's filters Glyph and Tube show it: grains by species,
contacts as wide as their normal force. Needs python3-vtk9; without a screen, xvfb-run:

    grseg-export run.h5 --to vtp --begin 40 --end 40.01 -o view
    xvfb-run -a scripts/figures/export.py view picture.png
"""
import os
import sys
import xml.etree.ElementTree

import vtk

COLOURS = ((0.97, 0.85, 0.55), (0.55, 0.72, 0.88), (0.7, 0.7, 0.7))  # small, large, boundary
WIDTH = 1200  # pixels


def last(folder, what):
    sets = xml.etree.ElementTree.parse(f"{folder}/{what}.pvd").findall("Collection/DataSet")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(folder, sets[-1].get("file")))
    reader.Update()
    return reader


def grains(reader):
    """A disc per grain, scaled by `diameter`, coloured by `species`."""
    disc = vtk.vtkRegularPolygonSource()  # of diameter 1
    disc.SetNumberOfSides(48)
    disc.SetRadius(0.5)
    glyph = vtk.vtkGlyph3DMapper()
    glyph.SetInputConnection(reader.GetOutputPort())
    glyph.SetSourceConnection(disc.GetOutputPort())
    glyph.SetScaleArray("diameter")
    glyph.SetScaleModeToScaleByMagnitude()
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(3)
    for k, colour in enumerate(COLOURS):
        table.SetTableValue(k, *colour)
    glyph.SetLookupTable(table)
    glyph.SetScalarModeToUsePointFieldData()
    glyph.SelectColorArray("species")
    glyph.SetScalarRange(0, 2)
    actor = vtk.vtkActor()
    actor.SetMapper(glyph)
    actor.GetProperty().LightingOff()
    return actor


def contacts(reader, widest):
    """A tube per contact, as wide as `normal_force`; the largest are `widest` wide."""
    largest = reader.GetOutput().GetPointData().GetArray("normal_force").GetRange()[1]
    reader.GetOutput().GetPointData().SetActiveScalars("normal_force")
    width = vtk.vtkArrayCalculator()
    width.SetInputData(reader.GetOutput())
    width.AddScalarArrayName("normal_force")
    width.SetFunction(f"max(normal_force, 0) * {widest / 2 / largest}")
    width.SetResultArrayName("width")
    tube = vtk.vtkTubeFilter()
    tube.SetInputConnection(width.GetOutputPort())
    tube.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "width")
    tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tube.SetNumberOfSides(12)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(tube.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.6, 0.05, 0.05)
    actor.GetProperty().LightingOff()
    actor.SetPosition(0, 0, widest)  # in front of the discs
    return actor


def draw(folder, path):
    reader = last(folder, "grains")
    low_x, high_x, low_y, high_y = reader.GetOutput().GetBounds()[:4]
    largest = reader.GetOutput().GetPointData().GetArray("diameter").GetRange()[1]
    width, height = high_x - low_x + 2 * largest, high_y - low_y + 2 * largest
    scene = vtk.vtkRenderer()
    scene.SetBackground(1, 1, 1)
    scene.AddActor(grains(reader))
    scene.AddActor(contacts(last(folder, "contacts"), 0.6 * largest))
    camera = scene.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(height / 2)
    middle = (low_x + high_x) / 2, (low_y + high_y) / 2
    camera.SetFocalPoint(*middle, 0)
    camera.SetPosition(*middle, 1)
    scene.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, round(WIDTH * height / width))
    window.AddRenderer(scene)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if len(sys.argv) != 3:
    sys.exit(__doc__)
draw(*sys.argv[1:])
