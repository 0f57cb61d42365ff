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
  void touchWorksOnAWaveletContour();
  void touchWorksOnARealMesh();
  void actionsAreInMenuToolBarAndCustomizeShortcuts();
  void touchIsDisabledWhereNothingCanBeTouchedAndSaysWhy();
  void touchOfPointsSaysWhatToDo();
  void whatMessagesAdviseEndsTheFault();
  void touchOfASecondSourceAddsIt();
  void closingTheViewReleasesTheHand();
  void deletingTheTouchedSourceLeavesFreeSpace();
  void resettingTheSessionReleasesTheHand();
  void aStateTakesThePlaceOfTheScene();
  void undoTakesTouchBack();
  void undoOfTouchReleasesAndSaysWhyAsLongAsItIsSo();
  void undoTakesTheFilterBack();
  void aDeviceThatIsNotThereIsReported();
  void findingDevicesShowsTheirStates();

  // HapticsGuiTestPanel.cxx: the panel, and what goes on in the background
  void theTimerRestsWhileReleased();
  void aRestingHandIsNotDrawnAgain();
  void theHandFollowsTheActiveView();
  void theHandIsInEveryViewThatShowsTheSurface();
  void undoKeepsTheMaterialOfASource();
  void panelAndProxyShowTheSameSettings();
  void thePanelSetsSizeAndVisibilityOfTheHand();
  void settingsAreWhatTouchBeginsWith();
  void landmarksBecomeASource();
  void aRecordingIsPlayedBack();
  void theForceChartFollowsTheHand();
  void strokesBecomeCurvesWithData();
  void aTraceIsPlottedByItsForce();
  void theTouchedCellIsSelected();
  void aKeyThatParaViewHasTooIsTheHandsWhileItTouches();
  void aDraggedContourIsFollowed();
  void aLargeSurfaceIsBuiltInTheBackground();
  void theHandIsDrawnOverTheRestOfThePicture();
  void theHandIsDrawnWithTheRestWhereThatIsNotKept_data();
  void theHandIsDrawnWithTheRestWhereThatIsNotKept();
  void buildingCanBeCancelled();
  void eachExampleCanBeTouchedAndUndone();
  void makePictureForReadme();
};

#endif
