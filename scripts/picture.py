#!/usr/bin/python3
"""Draws one answer of `condyle depth --out FOLDER` as a picture.

Usage: scripts/picture.py FOLDER PICTURE.png
Needs Debian's python3-vtk9; without a display run it under xvfb-run.

Both bones are drawn as they stand, side by side: the fixed one with the mobile one as glass before it, and the mobile
one alone. Triangles with all corners inside the other bone are red, those in contact orange.
"""
import sys

import vtk

BONE, GLASS, CONTACT, INSIDE = (0.93, 0.90, 0.82), (0.62, 0.72, 0.82), (0.95, 0.60, 0.15), (0.80, 0.08, 0.10)


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def surface(mesh, colour, opacity):
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SplittingOff()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetOpacity(opacity)
    return actor


def marked(mesh, array, on_points, colour):
    """The triangles marked 1 by an array, a hair in front of the surface."""
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(mesh)
    association = vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS if on_points else vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS
    threshold.SetInputArrayToProcess(0, 0, 0, association, array)
    threshold.SetUpperThreshold(0.5)
    threshold.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_UPPER)
    threshold.SetAllScalars(True)
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputConnection(threshold.GetOutputPort())
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-8, -8)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetAmbient(0.3)
    return actor


def renderer(actors, viewport, eye):
    scene = vtk.vtkRenderer()
    scene.SetBackground(1, 1, 1)
    scene.SetViewport(*viewport)
    for actor in actors:
        scene.AddActor(actor)
    camera = scene.GetActiveCamera()
    camera.SetPosition(*eye)
    camera.SetFocalPoint(10, 12, 10)
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(21)
    scene.ResetCameraClippingRange()
    return scene


def main():
    folder, picture = sys.argv[1:]
    fixed, mobile = read(folder + "/fixed.vtp"), read(folder + "/mobile.vtp")
    marks = {
        name: [marked(mesh, "in_contact", False, CONTACT), marked(mesh, "inside", True, INSIDE)]
        for name, mesh in (("fixed", fixed), ("mobile", mobile))
    }
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1400, 620)
    window.SetMultiSamples(8)
    eye = (330, 90, 330)
    window.AddRenderer(
        renderer([surface(fixed, BONE, 1), surface(mobile, GLASS, 0.35)] + marks["fixed"], (0, 0, 0.5, 1), eye)
    )
    behind = (150, 400, -160)
    window.AddRenderer(renderer([surface(mobile, BONE, 1)] + marks["mobile"], (0.5, 0, 1, 1), behind))
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


main()
