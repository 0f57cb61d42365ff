#ifndef Haptics_HapticsGuiTest_h
#define Haptics_HapticsGuiTest_h

#include <QObject>

/// The tests, each a slot, in the order in which they run.
class HapticsGuiTest : public QObject
{
  Q_OBJECT

private Q_SLOTS:
  void initTestCase();
  void init();

  // HapticsGuiTest.cxx: the button, and what may go wrong
  void touchFeelsAWaveletContour();
  void touchFeelsARealMesh();
  void touchIsDisabledWhereNothingCanBeTouchedAndSaysWhy();
  void touchOfPointsTellsWhatToDo();
  void touchOfASecondSourceAddsIt();
  void closingTheViewReleasesTheHand();
  void deletingTheTouchedSourceLeavesFreeSpace();
  void resettingTheSessionReleasesTheHand();
  void undoTakesTouchBack();
  void undoTakesTheFilterBack();
  void aDeviceThatIsNotThereTellsSo();
  void findingDevicesShowsTheirStates();

  // HapticsGuiTestPanel.cxx: the panel, and what goes on beside
  void theTimerRestsWhileReleased();
  void aRestingHandIsNotDrawnAgain();
  void theHandFollowsTheActiveView();
  void panelAndProxyShowTheSameSettings();
  void settingsAreWhatTouchBeginsWith();
  void landmarksBecomeASource();
  void aRecordingIsPlayedBack();
  void theForceChartFollowsTheHand();
  void strokesBecomeCurvesWithData();
  void aTraceIsPlottedByItsForce();
  void theTouchedCellIsSelected();
  void aDraggedContourIsFollowed();
  void aLargeSurfaceIsBuiltBeside();
  void buildingCanBeCancelled();
  void makePictureForReadme();
};

#endif
