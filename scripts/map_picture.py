#!/usr/bin/python3
"""Draws the maps of `condyle motion --out FOLDER --maps` at some of its frames, side by side, as one picture.

Usage: scripts/map_picture.py FOLDER ARRAY HIGHEST PICTURE.png FRAME [FRAME...]
Needs Debian's python3-vtk9; without a display run it under xvfb-run.

The mobile body is seen as its target sees it: a right tibia from above with anterior up, a patella from behind with superior up.
Grey is not in contact.
"""
import os
import sys

import vtk


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def colours(highest):
    """Dark to bright in even steps for any eye; grey below the first step."""
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToLab()
    for at, rgb in ((0, (0.20, 0.10, 0.35)), (0.35, (0.45, 0.15, 0.45)), (0.7, (0.90, 0.45, 0.25)), (1, (0.99, 0.90, 0.55))):
        table.AddRGBPoint(at * highest, *rgb)
    lookup = vtk.vtkLookupTable()
    lookup.SetNumberOfTableValues(256)
    lookup.SetRange(highest * 1e-6, highest)
    for i in range(256):
        lookup.SetTableValue(i, *table.GetColor(highest * i / 255), 1)
    lookup.UseBelowRangeColorOn()
    lookup.SetBelowRangeColor(0.85, 0.85, 0.85, 1)
    return lookup


def scale(lookup, array, left):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(lookup)
    bar.SetTitle(array.replace("_mpa", ", MPa").replace("_mm", ", mm"))
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.1f")
    bar.SetPosition(0.1, 0.1)
    bar.SetWidth(0.7)
    bar.SetHeight(0.8)
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetLabelTextProperty(), bar.GetTitleTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(13)
        text.ItalicOff()
        text.ShadowOff()
        text.BoldOff()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(left, 0, 1, 1)
    renderer.AddActor2D(bar)
    return renderer


def main():
    folder, array, highest, picture, *frames = sys.argv[1:]
    lookup = colours(float(highest))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    width = 420 * len(frames) + 120
    window.SetSize(width, 360)
    window.SetMultiSamples(8)
    for i, frame in enumerate(frames):
        mesh = read(os.path.join(folder, f"map_mobile_{int(frame):05}.vtp"))
        mesh.GetCellData().SetActiveScalars(array)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        mapper.SetScalarModeToUseCellData()
        mapper.SetLookupTable(lookup)
        mapper.UseLookupTableScalarRangeOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(420 * i / width, 0, 420 * (i + 1) / width, 1)
        renderer.AddActor(actor)
        # From the target's side of the casting surface: against the mean of its normals in contact.
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputData(mesh)
        normals.ComputeCellNormalsOn()
        normals.ComputePointNormalsOff()
        normals.ConsistencyOff()
        normals.Update()
        cells = normals.GetOutput().GetCellData().GetArray("Normals")
        mean = [sum(cells.GetTuple3(c)[k] for c in range(cells.GetNumberOfTuples())) for k in range(3)]
        camera = renderer.GetActiveCamera()
        centre = mesh.GetCenter()
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*(centre[k] + mean[k] for k in range(3)))
        # At a right angle to the view in the sagittal plane: it turns with the flexed body.
        camera.SetViewUp(mean[1], -mean[0], 0)
        camera.ParallelProjectionOn()
        renderer.ResetCamera()
        camera.Zoom(1.25)
        window.AddRenderer(renderer)
    window.AddRenderer(scale(lookup, array, 420 * len(frames) / width))
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    main()
