/**
 * @class   pqHapticsForceChart
 * @brief   A dock with the force of the last ten seconds, drawn while the hand touches.
 *
 * Takes every tick that the scene gives out, keeps the largest force of each hundredth of a second,
 * and draws ten times a second while it can be seen. The force axis goes up to the largest force
 * that the servo allows, so that the curve does not jump. A new run begins a new curve; after it
 * the last one stays. GUI thread.
 *
 * @sa pqHapticsActions
 */
#ifndef Haptics_pqHapticsForceChart_h
#define Haptics_pqHapticsForceChart_h

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <QDockWidget>
#include <QElapsedTimer>

#include <deque>

class QVTKOpenGLNativeWidget;
class vtkChartXY;
class vtkContextView;
class vtkHapticScene;
class vtkTable;

class pqHapticsForceChart : public QDockWidget
{
  Q_OBJECT
  using Superclass = QDockWidget;

public:
  explicit pqHapticsForceChart(QWidget* parent = nullptr);
  ~pqHapticsForceChart() override;

  struct Sample
  {
    double Time;  ///< [s] since the servo's start
    double Force; ///< [N], the largest until the next sample
  };
  /** What is drawn, oldest first. */
  const std::deque<Sample>& samples() const { return this->Samples; }

  static constexpr double Span = 10.0;     ///< of the time axis [s]
  static constexpr double Interval = 0.01; ///< between samples [s]

private:
  Q_DISABLE_COPY(pqHapticsForceChart)

  void followScene();
  void takeTicks();
  void draw();

  vtkWeakPointer<vtkHapticScene> Scene;
  unsigned long Observer = 0;
  std::deque<Sample> Samples;
  bool IsOld = true; // the picture lacks samples
  QElapsedTimer SinceDrawing;
  QVTKOpenGLNativeWidget* Widget;
  vtkNew<vtkContextView> View;
  vtkNew<vtkChartXY> Chart;
  vtkNew<vtkTable> Table;
  vtkNew<vtkTable> LimitTable; // of the line at the largest force
};

#endif
