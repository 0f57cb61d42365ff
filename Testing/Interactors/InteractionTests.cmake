# Scene, style, devices and props that need no servo thread of their own, and their pictures.

# Threads run in some of these, but no time is asserted.
haptics_add_gtest(TestHapticScene
  TestBackgroundBuilding.cxx
  TestChangingSurfaces.cxx
  TestGeodesicDistance.cxx
  TestGrip.cxx
  TestGripBadInput.cxx
  TestHapticScene.cxx
  TestHapticSceneActors.cxx
  TestHapticSceneAssemblies.cxx
  TestHapticSceneBadInput.cxx
  TestHapticSceneWorkspace.cxx
  TestMovingActors.cxx
  TestOneTick.cxx
  TestSceneProperties.cxx
  TestSceneSides.cxx
  TestSceneEvents.cxx
  TestSurfaceSwaps.cxx
  LIBRARIES Haptics::Devices Haptics::Filters Haptics::Interactors VTK::FiltersCore
            VTK::FiltersSources VTK::RenderingOpenGL2)
haptics_add_gtest(TestInteractorStyleHaptic
  TestInteractorStyleHaptic.cxx
  TestMouseHapticDevice.cxx
  TestTrail.cxx
  LIBRARIES Haptics::Devices Haptics::Interactors VTK::FiltersSources VTK::RenderingFreeType
            VTK::RenderingOpenGL2 VTK::RenderingUI)
haptics_add_gtest(TestInteractorStyleTimer
  TestInteractorStyleTimer.cxx
  LIBRARIES Haptics::Devices Haptics::Interactors VTK::FiltersSources VTK::RenderingFreeType
            VTK::RenderingOpenGL2 VTK::RenderingUI)

# Baselines are in Testing/Data/Baseline.
vtk_add_test_cxx(HapticsImageTests haptics_image_tests
  NO_DATA
  TestCarry.cxx
  TestConcaveCorner.cxx
  TestConvexEdge.cxx
  TestFreeTouchingPressed.cxx
  TestGodObjectActor.cxx
  TestMarks.cxx
  TestMouseTouch.cxx
  TestOcclusion.cxx
  TestSeveralSurfaces.cxx
  TestThinPlate.cxx)
vtk_test_cxx_executable(HapticsImageTests haptics_image_tests RENDERING_FACTORY)
target_link_libraries(HapticsImageTests PRIVATE
  Haptics::Devices Haptics::Interactors VTK::FiltersSources VTK::RenderingFreeType
  VTK::RenderingOpenGL2 VTK::RenderingUI VTK::TestingRendering)
vtk_module_autoinit(TARGETS HapticsImageTests
  MODULES VTK::RenderingFreeType VTK::RenderingOpenGL2 VTK::RenderingUI)
