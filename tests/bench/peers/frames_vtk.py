"""Draws the mesh that `frames DIR` wrote as VTK users do, off screen (xvfb-run), PNG included: surface coloured by node values, springs as lines. Prints frames a second."""
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

folder, out = sys.argv[1], sys.argv[2]
triangles = np.loadtxt(f"{folder}/triangles.txt", dtype=np.int64)
springs = np.loadtxt(f"{folder}/springs.txt", dtype=np.int64)
values = np.loadtxt(f"{folder}/values.txt")
places = np.loadtxt(f"{folder}/places.txt").reshape(-1, len(values), 2)


def cells(corners):
    flat = np.hstack([np.full((len(corners), 1), corners.shape[1], dtype=np.int64), corners]).ravel()
    array = vtk.vtkCellArray()
    array.SetCells(len(corners), numpy_to_vtkIdTypeArray(flat, deep=True))
    return array


def xyz(place):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.column_stack([place, np.zeros(len(place))]), deep=True))
    return points


surface, lines = vtk.vtkPolyData(), vtk.vtkPolyData()
surface.SetPolys(cells(triangles))
lines.SetLines(cells(springs))
scalars = numpy_to_vtk(values, deep=True)
surface.GetPointData().SetScalars(scalars)
renderer = vtk.vtkRenderer()
renderer.SetBackground(1, 1, 1)
for data, coloured in ((surface, True), (lines, False)):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(coloured)
    mapper.SetScalarRange(0, values.max())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetLighting(False)
    actor.GetProperty().SetColor(0.1, 0.1, 0.2)
    renderer.AddActor(actor)
bar = vtk.vtkScalarBarActor()
bar.SetLookupTable(renderer.GetActors().GetItemAsObject(0).GetMapper().GetLookupTable())
renderer.AddActor2D(bar)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(1280, 720)
window.AddRenderer(renderer)
times = []
for k, place in enumerate(places[:12]):
    start = time.perf_counter()
    surface.SetPoints(xyz(place))
    lines.SetPoints(xyz(place + 0.0))
    if k == 0:
        renderer.GetActiveCamera().ParallelProjectionOn()
        renderer.ResetCamera()
        renderer.GetActiveCamera().SetParallelScale(2.5)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetCompressionLevel(1)
    writer.SetFileName(f"{out}/vtk_{k:03}.png")
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    times.append(time.perf_counter() - start)
times = sorted(times[1:])
print(f"VTK {vtk.vtkVersion.GetVTKVersion()}: {1 / times[0]:.2f} frames a second at best, {1 / times[len(times) // 2]:.2f} in the median")
