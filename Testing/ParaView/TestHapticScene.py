"""Touches what a render view shows, in virtual time: what can be touched, and what follows."""

import math
import re
import time

import numpy as np
from HapticSceneTesting import SceneTest, haptics, look_at, main, trace_arrays, write_line, write_path
from paraview import simple


class TestHapticScene(SceneTest):
    def test_what_the_view_says_names_the_cell_of_the_source(self):
        box = self.make("Box")  # whose quadrilaterals become two triangles each
        self.touch(box)
        self.hand.step(1200)
        self.assertEqual(self.hand.Touching, 1)
        text = self.hand.vtk.GetProbe().GetText()
        self.assertIn(f"cell {self.hand.TouchedCell}\n", text)
        self.assertLess(self.hand.TouchedCell, 6)
        self.assertNotIn("vtkOriginal", text)

    def test_a_simulated_hand_strokes_what_is_shown(self):
        self.touch(self.make("Sphere", Radius=2.0, ThetaResolution=48, PhiResolution=48))
        self.hand.step(1500)
        self.assertEqual((self.hand.Touching, self.hand.TouchedRepresentation), (1, 0))
        self.assertEqual(self.hand.State, "Released")  # no device is engaged in virtual time
        self.assertGreater(self.hand.ForceMagnitude, 0.5)
        self.assertLessEqual(self.hand.ForceMagnitude, 3.3 + 1e-12)
        radius = math.dist(self.hand.GodObject, (0.0, 0.0, 0.0))
        self.assertAlmostEqual(radius, 2.0, delta=0.01)  # facets lie up to 4 mm inside the sphere
        self.assertIn("Normals", list(self.hand.ProbedValues))
        self.assertGreaterEqual(self.hand.TouchedCell, 0)

    def test_the_parts_have_proxies_whose_properties_are_those_of_the_scene_too(self):
        self.touch(self.make("Sphere"))
        scene = self.hand.proxy.SMProxy
        for part, name in (("Picture", "ShowTrail"), ("Readings", "Touching"), ("Records", "RecordTrace"),
                           ("Workspace", "WorkspaceTransform")):
            self.assertEqual(scene.GetProperty(name).GetParent().GetXMLName(), "Haptic" + part)
        trail = self.hand.picture.GetGodObjectActor()
        self.assertFalse(trail.GetShowTrail())
        scene.GetProperty("ShowTrail").GetParent().GetProperty("ShowTrail").SetElement(0, 1)
        scene.UpdateVTKObjects()
        self.assertEqual((self.hand.ShowTrail, trail.GetShowTrail()), (1, True))
        self.hand.ShowTrail = 0
        self.assertFalse(trail.GetShowTrail())

    def test_surfaces_are_named_as_the_pipeline_browser_does(self):
        display = self.touch(self.make("Sphere", registrationName="Femur"))
        self.hand.step(1500)
        scene = self.hand.vtk
        surface = scene.GetSurfaces().GetId(0)
        self.assertEqual(scene.GetSurfaces().GetName(surface), "Femur")
        probe = scene.GetProbe()
        self.assertEqual(probe.GetSurfaceName(), "Femur")
        display.Scale = [1.0, 0.0, 1.0]
        simple.Render(self.view)
        with self.assertRaisesRegex(haptics.HapticsError, r"^Surface \d+ \(Femur\): .*flattens"):
            self.hand.step(1)
        display.Scale = [1.0, 1.0, 1.0]
        simple.RenameSource("Tibia", self.made[0])
        self.assertEqual(scene.GetSurfaces().GetName(surface), "Tibia")

    def test_what_is_hidden_or_not_touchable_is_not_touched(self):
        display = self.touch(self.make("Sphere"))
        self.hand.step(1500)
        self.assertEqual(self.hand.Touching, 1)
        for name, no, yes in (
            ("Visibility", 0, 1),
            ("Touchable", 0, 1),
        ):
            setattr(display, name, no)
            simple.Render(self.view)
            self.hand.step(10)
            self.assertEqual((self.hand.Touching, self.hand.ForceMagnitude), (0, 0.0), name)
            setattr(display, name, yes)
            simple.Render(self.view)
            self.hand.step(10)
            self.assertEqual(self.hand.NumberOfTouchableSurfaces, 1, name)

    def test_it_is_touched_however_it_is_drawn(self):
        display = self.touch(self.make("Sphere"))
        forces = set()
        for kind in ("Surface", "Surface With Edges", "Wireframe", "Points", "Outline", "Haptic Surface"):
            display.SetRepresentationType(kind)
            simple.Render(self.view)
            self.hand.set(RecordTrace=0, WorkspaceTransform=16 * [0.0])
            self.hand.set(RecordTrace=1)
            self.hand.release()
            self.hand.step(800)
            trace = trace_arrays(self.hand)
            self.assertGreater((trace["ActiveConstraints"] > 0).sum(), 200, kind)
            forces.add(round(float(abs(trace["Force"]).max()), 9))
        self.assertEqual(len(forces), 1)

    def test_every_kind_of_data_whose_outside_is_a_surface_is_touched(self):
        sphere = self.make("Sphere")
        wavelet = self.make("Wavelet", WholeExtent=[-5, 5, -5, 5, -5, 5])
        kinds = {
            "image": wavelet,
            "unstructured grid": self.make("Clip", Input=wavelet, ClipType="Plane"),
            "structured grid": self.make("Transform", Input=wavelet),
            "multiblock": self.make("GroupDatasets", Input=[sphere, self.make("Cone")]),
            "partitioned": self.make("GroupDatasets", Input=[sphere, self.make("Box")],
                                     OutputType="vtkPartitionedDataSetCollection"),
        }
        for name, source in kinds.items():
            with self.subTest(name):
                self.hand.set(Surfaces=[], RecordTrace=0)
                self.touch(source)
                self.hand.fit()
                self.hand.RecordTrace = 1
                self.hand.step(2000)
                self.assertEqual(self.hand.NumberOfTouchableSurfaces, 1)
                self.assertGreater((trace_arrays(self.hand)["ActiveConstraints"] > 0).sum(), 500)
                surface = self.touched_surface()
                self.assertEqual(surface.GetFieldData().GetArray("BoundaryEdges").GetValue(0), 0)

    def test_only_the_blocks_that_are_shown_are_touched(self):
        first = self.make("Sphere", registrationName="First")
        second = self.make("Sphere", registrationName="Second", Center=[0.6, 0.0, 0.0])
        display = self.touch(self.make("GroupDatasets", Input=[first, second]))
        self.hand.step(10)
        everything = self.touched_surface().GetNumberOfPolys()
        for selector, count in (("/Root/First", everything // 2), ("/", everything)):
            display.BlockSelectors = [selector]
            simple.Render(self.view)
            self.hand.step(10)
            self.assertEqual(self.touched_surface().GetNumberOfPolys(), count, selector)

    def test_an_array_chooses_the_side_of_each_cell(self):
        balls = [self.make("Sphere", Center=[x, 0, 0]) for x in (0.0, 2.0)]
        parts = [self.make("Calculator", Input=ball, ResultArrayName="sides", Function=str(i),
                           AttributeType="Cell Data") for i, ball in enumerate(balls)]
        display = self.touch(self.make("AppendGeometry", Input=parts))
        domain = display.GetProperty("HapticSideArray").SMProperty.GetDomain("array_list")
        names = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
        self.assertIn("sides", names)
        self.assertNotIn("Normals", names, "an array of points")
        for array, side in (("", "Front"), ("sides", "Mixed"), ("", "Front")):
            display.HapticSideArray = ["CELLS", array]
            simple.Render(self.view)
            self.hand.step(10)
            touched = self.touched_surface().GetFieldData().GetAbstractArray("TouchedSide")
            self.assertEqual(touched.GetValue(0), side)

    def test_the_touch_follows_transforms_and_filters_upstream(self):
        source = self.make("Sphere", ThetaResolution=40, PhiResolution=40)
        display = self.touch(source)
        self.hand.RecordTrace = 1
        self.hand.step(2000)

        def largest_reach(center, scale):
            simple.Render(self.view)
            self.hand.RecordTrace = 0
            self.hand.RecordTrace = 1
            self.hand.fit()
            self.hand.step(2000)
            arrays = trace_arrays(self.hand)
            touching = arrays["ActiveConstraints"] > 0
            self.assertGreater(touching.sum(), 500)
            return np.linalg.norm((arrays["GodObject"][touching] - center) / scale, axis=1)

        place = "Translation" if hasattr(display, "Translation") else "Position"  # ParaView 5.13
        # Facets lie up to 0.002 within the sphere of radius 0.5.
        setattr(display, place, [10.0, 0.0, 0.0])
        look_at(self.view)
        self.assertLess(abs(largest_reach([10.0, 0.0, 0.0], 1.0) - 0.5).max(), 0.003)
        display.Scale = [2.0, 3.0, 4.0]
        look_at(self.view)
        reach = largest_reach([10.0, 0.0, 0.0], [2.0, 3.0, 4.0])
        self.assertLess(abs(reach - 0.5).max(), 0.003)
        source.Radius = 1.0
        look_at(self.view)
        reach = largest_reach([10.0, 0.0, 0.0], [2.0, 3.0, 4.0])
        self.assertLess(abs(reach - 1.0).max(), 0.006)
        setattr(display, place, [0.0, 0.0, 0.0])
        display.Scale = [1.0, 1.0, 1.0]
        if hasattr(display, "UserTransform"):
            display.UserTransform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5, 0, 0, 0, 1]
            look_at(self.view)
            self.assertLess(abs(largest_reach([0.0, 0.0, 5.0], 1.0) - 1.0).max(), 0.006)

    def growing_sphere(self):
        """A closed sphere whose radius is 1 + 0.1 t, at the times 0, 1 and 2."""
        source = self.make("ProgrammableSource", OutputDataSetType="vtkPolyData")
        source.ScriptRequestInformation = """
executive = self.GetExecutive()
information = executive.GetOutputInformation(0)
information.Set(executive.TIME_STEPS(), [0.0, 1.0, 2.0], 3)
information.Set(executive.TIME_RANGE(), [0.0, 2.0], 2)"""
        source.Script = """
from vtkmodules.vtkFiltersSources import vtkSphereSource
executive = self.GetExecutive()
sphere = vtkSphereSource()
sphere.SetThetaResolution(40)
sphere.SetPhiResolution(40)
sphere.SetRadius(1.0 + 0.1 * executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP()))
sphere.Update()
self.GetOutput().ShallowCopy(sphere.GetOutput())"""
        source.UpdatePipelineInformation()
        simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
        simple.GetAnimationScene().AnimationTime = 0.0
        self.touch(source)

    def show_time(self, time_now):
        simple.GetAnimationScene().AnimationTime = time_now
        simple.Render(self.view)

    def test_an_animation_changes_what_is_touched(self):
        self.growing_sphere()
        for now in (0.0, 2.0, 1.0, 0.0):  # a time seen before comes out of ParaView's cache
            self.show_time(now)
            self.hand.fit()  # and the stroke starts anew
            self.hand.step(1500)
            self.assertEqual(self.hand.Touching, 1, f"time {now}")
            radius = math.dist(self.hand.GodObject, (0.0, 0.0, 0.0))
            self.assertAlmostEqual(radius, 1.0 + 0.1 * now, delta=0.006, msg=f"time {now}")

    def test_contact_is_carried_over_when_time_goes_on(self):
        self.growing_sphere()
        self.hand.step(1500)
        for now in (1.0, 2.0):
            self.show_time(now)
            self.hand.step(20)
            self.assertEqual(self.hand.Touching, 1, f"time {now}")
            radius = math.dist(self.hand.GodObject, (0.0, 0.0, 0.0))
            self.assertAlmostEqual(radius, 1.0 + 0.1 * now, delta=0.006, msg=f"time {now}")

    def test_an_engaged_hand_stays_in_contact_while_time_goes_on(self):
        self.growing_sphere()
        file = "TestHapticScene_press.vtp"  # into the sphere, and there it stays
        write_line(file, [0.2, 0.1, 1.4], [0.2, 0.1, 0.93])
        self.hand.set(Device=file)
        self.hand.engage()
        end = time.monotonic() + 60.0

        def wait_for(condition, what):
            while not condition():
                self.assertLess(time.monotonic(), end, what)
                time.sleep(0.005)
                self.hand.update()

        wait_for(lambda: self.hand.Touching, "a contact")
        lost = []
        ended = self.hand.vtk.AddObserver(self.hand.vtk.ContactEndEvent, lambda *_: lost.append(1))
        for now in (1.0, 2.0):
            self.show_time(now)
            wait_for(lambda: self.hand.Touching and math.dist(self.hand.GodObject, (0.0, 0.0, 0.0))
                     > 1.0 + 0.1 * now - 0.01, f"the surface of time {now}")
        self.hand.vtk.RemoveObserver(ended)
        self.assertEqual(lost, [])

    def test_both_sides_are_touched_where_that_is_asked_for(self):
        sphere = self.make("Sphere", ThetaResolution=32, PhiResolution=32)
        self.touch(sphere)
        file = "TestHapticScene_inside.vtp"
        write_line(file, [0.0, 0.0, 0.0], [0.0, 0.1, 0.7])
        for side, touching in (("Front", 0), ("Both", 1)):
            self.hand.set(Device="none")
            self.hand.set(Device=file, Side=side)
            self.hand.step(4000)
            self.assertEqual(self.hand.Touching, touching, side)

    def test_the_same_path_gives_the_same_trace(self):
        self.touch(self.make("Sphere", ThetaResolution=32, PhiResolution=32))
        self.hand.RecordTrace = 1
        self.hand.step(1500)
        write_path(self.hand, "TestHapticScene_path.vtp")
        strokes = []
        for _ in range(2):
            self.hand.set(Device="none")
            self.hand.set(Device="TestHapticScene_path.vtp", RecordTrace=0)
            self.hand.RecordTrace = 1
            self.hand.step(1500)
            strokes.append(trace_arrays(self.hand))
        self.assertGreater((strokes[0]["ActiveConstraints"] > 0).sum(), 500)
        for name in strokes[0]:
            np.testing.assert_array_equal(strokes[0][name], strokes[1][name], name)

    def test_landmarks_and_trace_become_sources(self):
        self.touch(self.make("Sphere"))
        self.hand.RecordTrace = 1
        ticks = self.step_to_contact(1500)
        self.hand.drop_landmark()
        ticks += self.step_to_contact(300)
        self.hand.drop_landmark()
        self.assertEqual(self.hand.NumberOfLandmarks, 2)
        landmarks, trace = self.hand.landmark_source(), self.hand.trace_source()
        self.made += [landmarks, trace]
        landmarks.UpdatePipeline()
        trace.UpdatePipeline()
        self.assertEqual(landmarks.GetDataInformation().GetNumberOfPoints(), 2)
        self.assertIn("DistanceToPrevious", landmarks.PointData.keys())
        self.assertEqual(trace.GetDataInformation().GetNumberOfPoints(), ticks)
        self.assertIn("Force", trace.PointData.keys())
        self.hand.proxy.InvokeCommand("RemoveLastLandmark")
        self.assertEqual(self.hand.NumberOfLandmarks, 1)
        self.hand.proxy.InvokeCommand("ClearLandmarks")
        self.assertEqual(self.hand.NumberOfLandmarks, 0)

    def test_landmarks_have_numbers_and_distances_and_outlive_the_hand(self):
        self.touch(self.make("Sphere", ThetaResolution=48, PhiResolution=48))
        for _ in range(2):
            self.step_to_contact(1500)
            self.hand.drop_landmark()
        straight = self.hand.vtk.GetLandmarks().GetStraightDistance(0, 1)
        along = self.hand.vtk.GetLandmarks().GetGeodesicDistance(0, 1)
        self.assertGreater(along, straight)

        def texts():
            marks = self.hand.landmarks().GetPointData().GetAbstractArray("Text")
            return [marks.GetValue(i) for i in range(2)]

        self.assertEqual(texts(), ["1", f"2: {straight:.5g}"])
        self.hand.set(ShowForce=0)
        self.hand.LandmarkDistance = "Along Surface"
        self.assertEqual(texts(), ["1", f"2: {along:.5g}"])
        second = self.hand.landmarks().GetPoint(1)
        self.view.CameraPosition = [4.0 * coordinate for coordinate in second]
        self.hand.set(Device="none")  # the hand is gone, and what it marked is seen
        self.hand.update()
        marked = self.picture()
        self.hand.LandmarkDistance = "None"
        self.assertEqual(texts(), ["1", "2"])
        self.hand.update()
        numbered = self.picture()
        self.assertTrue((marked != numbered).any(), "the distance was drawn")
        self.hand.proxy.InvokeCommand("ClearLandmarks")
        self.hand.update()
        self.assertTrue((numbered != self.picture()).any(), "balls and numbers were drawn")

    def test_landmarks_and_trace_come_back_with_data_of_any_name(self):
        name = 'a"<&> % %41 \u00e9 </VTKFile>'  # VTK writes names into XML as they are
        sphere = self.make("Sphere", ThetaResolution=48, PhiResolution=48)
        self.touch(self.make("PythonCalculator", Input=sphere, Expression="Normals[:,0]", ArrayName=name))
        self.hand.RecordTrace = 1
        self.step_to_contact(1500)
        self.hand.drop_landmark()
        marks = self.hand.vtk.GetLandmarks()
        value, contents = marks.GetLandmark(0).GetValue(name), self.hand.LandmarkContents
        self.assertTrue(math.isfinite(value))
        self.hand.LandmarkContents = ""
        self.assertEqual(self.hand.NumberOfLandmarks, 0)
        self.hand.LandmarkContents = contents
        self.assertEqual(self.hand.NumberOfLandmarks, 1)
        self.assertEqual(marks.GetLandmark(0).GetValue(name), value)
        source = self.hand.trace_source()
        self.made.append(source)
        source.UpdatePipeline()
        self.assertIn(name, source.PointData.keys())
        self.hand.proxy.InvokeCommand("ClearLandmarks")

    def test_landmarks_are_kept_where_their_text_was_cut_or_changed(self):
        self.touch(self.make("Sphere", ThetaResolution=48, PhiResolution=48))
        self.step_to_contact(1500)
        self.hand.drop_landmark()
        self.hand.drop_landmark()
        contents = self.hand.LandmarkContents
        first, end = contents.index("<VTKFile"), contents.index("</VTKFile>")
        older = re.sub(' check="[0-9a-f]*"', "", contents)  # as earlier versions wrote it
        self.assertNotEqual(older, contents)
        self.hand.LandmarkContents = ""
        self.hand.LandmarkContents = older
        self.assertEqual(self.hand.NumberOfLandmarks, 2)
        self.hand.step(1)
        contents = self.hand.LandmarkContents
        damaged = {
            "garbage": 1, "</VTKFile>": 1, "<x></VTKFile>": 1, contents[:first]: 1, contents[: end // 2]: 1,
            contents[:-20]: 2, contents[: end // 2] + contents[end // 2 + 4:]: 1,
            contents.replace("AQAA", "AAAA"): 1, contents.replace("AQAA", "zzzz"): 1,
            contents.replace('NumberOfTuples="1"', 'NumberOfTuples="99999999999"'): 1,
        }
        for text, number in damaged.items():
            with self.subTest(text=text[:200]):
                with self.assertRaisesRegex(haptics.HapticsError, f"Landmark {number} of . in LandmarkContents"):
                    self.hand.LandmarkContents = text
                self.hand.step(1)
                self.assertEqual(self.hand.Message, "")
                self.hand.proxy.LandmarkContents = text  # as a state does
                self.assertRegex(self.hand.Message, f"^Landmark {number} of . in LandmarkContents cannot be read")
                self.assertEqual((self.hand.NumberOfLandmarks, self.hand.LandmarkContents), (2, contents))
                source = self.make("HapticRecord", Contents=text)
                source.UpdatePipeline()
                points = source.GetDataInformation().GetNumberOfPoints()
                self.assertEqual(points, 0)
        self.hand.proxy.InvokeCommand("ClearLandmarks")

    def test_landmarks_of_an_older_text_find_their_surface_after_it_was_renamed(self):
        sphere = self.make("Sphere", ThetaResolution=48, PhiResolution=48)
        display = self.touch(sphere)
        self.step_to_contact(1500)
        self.hand.drop_landmark()
        contents = self.hand.LandmarkContents
        simple.RenameSource("Skull", sphere)
        self.hand.step(1)
        place = self.hand.landmarks().GetPoint(0)
        for moved in (0.0, 0.5):  # where it is not where it was, nobody knows that it is the same
            display.Position = [moved, 0.0, 0.0]
            self.hand.LandmarkContents = ""
            self.hand.step(1)
            self.hand.LandmarkContents = contents
            self.hand.step(1)
            self.assertEqual(self.hand.NumberOfFreeLandmarks, 1 if moved else 0)
            self.assertEqual(self.hand.landmarks().GetPoint(0), place)
        self.hand.proxy.InvokeCommand("ClearLandmarks")

    def test_a_text_of_landmarks_that_move_is_made_only_where_it_is_asked_for(self):
        display = self.touch(self.make("Sphere", ThetaResolution=48, PhiResolution=48))
        self.step_to_contact(1500)
        self.hand.drop_landmark()
        held = self.hand.proxy.SMProxy.GetProperty("LandmarkContents")
        before = self.hand.LandmarkContents
        display.Position = [0.5, 0.0, 0.0]
        display.SMProxy.UpdateVTKObjects()
        self.hand.update()
        self.assertEqual((len(self.hand.WorkspaceTransform), self.hand.NumberOfLandmarks), (16, 1))
        self.assertEqual(held.GetElement(0), before)
        self.assertNotEqual(self.hand.LandmarkContents, before)
        self.assertEqual(held.GetElement(0), self.hand.LandmarkContents)
        self.hand.proxy.LandmarkContents = "garbage"  # refused, the property has what is there
        self.assertEqual(held.GetElement(0), self.hand.LandmarkContents)
        self.hand.proxy.InvokeCommand("ClearLandmarks")

    def test_a_landmark_comes_back_without_arrays_that_have_no_name(self):
        script = """
from vtkmodules.vtkCommonCore import vtkFloatArray
output.ShallowCopy(inputs[0].VTKObject)
for data in (output.VTKObject.GetPointData(), output.VTKObject.GetCellData()):
    count = data.GetArray(0).GetNumberOfTuples() if data.GetArray(0) else output.VTKObject.GetNumberOfCells()
    array = vtkFloatArray()
    array.SetNumberOfTuples(count)
    array.Fill(3.0)
    data.AddArray(array)
"""
        sphere = self.make("Sphere", ThetaResolution=48, PhiResolution=48)
        self.touch(self.make("ProgrammableFilter", Input=sphere, Script=script))
        self.step_to_contact(1500)
        self.hand.drop_landmark()

        def names():
            values = self.hand.vtk.GetLandmarks().GetLandmark(0).GetPointValues()
            return [values.GetArrayName(i) for i in range(values.GetNumberOfArrays())]

        self.assertIn(None, names())
        contents, named = self.hand.LandmarkContents, [name for name in names() if name]
        self.hand.LandmarkContents = ""
        self.hand.LandmarkContents = contents
        self.assertEqual((self.hand.NumberOfLandmarks, names()), (1, named))
        self.hand.proxy.InvokeCommand("ClearLandmarks")

    def test_in_free_space_no_landmark_is_dropped(self):
        self.touch(self.make("Sphere"))
        self.hand.step(10)
        with self.assertRaisesRegex(haptics.HapticsError, "nothing is touched"):
            self.hand.drop_landmark()

    def picture(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

        simple.Render(self.view)
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.view.GetClientSideObject().GetRenderWindow())
        grab.ReadFrontBufferOff()
        grab.Update()
        return np.array(vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()), dtype=int)

    def test_the_hand_is_seen(self):
        self.touch(self.make("Sphere", ThetaResolution=48, PhiResolution=48))
        self.hand.set(ShowForce=0)
        before = self.picture()
        self.hand.step(1500)
        changed = (abs(self.picture() - before).max(axis=1) > 40).sum()
        self.assertGreater(changed, 25)  # god-object, arrow: a per cent of the picture
        self.assertLess(changed, 3000)

    def test_engaged_the_servo_runs_and_releases(self):
        self.touch(self.make("Sphere"))
        self.hand.engage()
        self.assertEqual(self.hand.EngagedInfo, 1)
        end = time.monotonic() + 20.0
        while not self.hand.Touching and time.monotonic() < end:
            time.sleep(0.01)
            self.hand.update()
        self.assertEqual((self.hand.Touching, self.hand.State), (1, "Engaged, touching Sphere1"))
        self.assertGreater(self.hand.Rate, 100.0)
        self.hand.release()
        self.assertEqual((self.hand.ForceMagnitude, self.hand.State), (0.0, "Released"))


if __name__ == "__main__":
    main()
