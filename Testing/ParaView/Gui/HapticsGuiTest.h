#ifndef HapticsGuiTest_h
#define HapticsGuiTest_h

#include <QObject>

/// The tests, each a slot, in the order in which they run.
class HapticsGuiTest : public QObject
{
  Q_OBJECT

private Q_SLOTS:
  void initTestCase();
  void init();

  void touchFeelsAWaveletContour();
  void touchFeelsARealMesh();
  void touchWithoutASourceTellsWhatToDo();
  void touchOfPointsTellsWhatToDo();
  void touchInAChartViewTellsWhatToDo();
  void closingTheViewReleasesTheHand();
  void deletingTheTouchedSourceLeavesFreeSpace();
  void resettingTheSessionReleasesTheHand();
  void undoTakesTheRepresentationBack();
};

#endif
