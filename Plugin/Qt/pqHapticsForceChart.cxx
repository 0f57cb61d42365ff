#include "pqHapticsForceChart.h"

#include "haptics/Math/Vec3Operations.h"
#include "haptics/Tick/TickRecord.h"
#include "pqHapticsManager.h"
#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContextScene.h"
#include "vtkContextView.h"
#include "vtkFloatArray.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkTable.h"

#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include <algorithm>

namespace
{
constexpr qint64 DrawInterval = 100;   // [ms]
constexpr double UnlimitedForce = 3.3; // [N], the axis where nothing limits the force
constexpr const char* EmptyTitle = "The force is drawn here while the hand is engaged";
constexpr double Headroom = 1.05; // of the axis above the largest force
}

pqHapticsForceChart::pqHapticsForceChart(QWidget* parent)
  : Superclass("Haptic Force", parent)
  , Widget(new QVTKOpenGLNativeWidget(this))
{
  this->setObjectName("HapticsForceChart");
  this->setWidget(this->Widget);
  this->Widget->setMinimumHeight(120);
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  this->Widget->setRenderWindow(window);
  this->View->SetRenderWindow(window);
  this->View->SetInteractor(this->Widget->interactor());

  for (vtkTable* table : { this->Table.Get(), this->LimitTable.Get() })
  {
    for (const char* name : { "Time [s]", "Force [N]" })
    {
      vtkNew<vtkFloatArray> column;
      column->SetName(name);
      table->AddColumn(column);
    }
  }
  this->LimitTable->SetNumberOfRows(2);
  vtkPlot* line = this->Chart->AddPlot(vtkChart::LINE);
  line->SetInputData(this->Table, 0, 1);
  line->SetColor(200, 60, 20, 255);
  line->SetWidth(2.0f);
  line->SetVisible(false);
  // Always there: a chart with no line to show draws no axes either.
  vtkPlot* limit = this->Chart->AddPlot(vtkChart::LINE);
  limit->SetInputData(this->LimitTable, 0, 1);
  limit->SetColor(128, 128, 128, 255);
  limit->GetPen()->SetLineType(vtkPen::DASH_LINE);
  this->Chart->GetAxis(vtkAxis::BOTTOM)->SetTitle("Time [s]");
  this->Chart->GetAxis(vtkAxis::LEFT)->SetTitle("Force [N]");
  for (const int axis : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    this->Chart->GetAxis(axis)->SetBehavior(vtkAxis::FIXED);
  }
  this->View->GetScene()->AddItem(this->Chart);

  // Shown, it has axes and a word at once; but not before there is something to draw on.
  this->connect(this, &QDockWidget::visibilityChanged, this,
    [this]
    {
      this->IsOld = true;
      QTimer::singleShot(DrawInterval, this, &pqHapticsForceChart::draw);
    });
  pqHapticsManager* manager = pqHapticsManager::instance();
  this->connect(manager, &pqHapticsManager::sceneChanged, this, &pqHapticsForceChart::followScene);
  this->connect(manager, &pqHapticsManager::updated, this, &pqHapticsForceChart::draw);
  this->followScene();
}

pqHapticsForceChart::~pqHapticsForceChart()
{
  if (this->Scene)
  {
    this->Scene->RemoveObserver(this->Observer);
  }
}

void pqHapticsForceChart::followScene()
{
  vtkHapticScene* scene = pqHapticsManager::instance()->hand();
  if (scene == this->Scene)
  {
    return;
  }
  if (this->Scene)
  {
    this->Scene->RemoveObserver(this->Observer);
  }
  this->Scene = scene;
  if (scene)
  {
    this->Observer =
      scene->AddObserver(vtkHapticScene::StateEvent, this, &pqHapticsForceChart::takeTicks);
  }
  this->draw();
}

void pqHapticsForceChart::takeTicks()
{
  for (const haptics::TickRecord& tick : this->Scene->GetNewTicks())
  {
    const double force = haptics::Length(tick.WorldForce);
    if (!this->Samples.empty() && tick.Time < this->Samples.back().Time)
    {
      this->Samples.clear(); // another run
    }
    if (this->Samples.empty() || tick.Time >= this->Samples.back().Time + Interval)
    {
      this->Samples.push_back({ tick.Time, force });
    }
    else
    {
      this->Samples.back().Force = std::max(this->Samples.back().Force, force);
    }
    this->IsOld = true;
  }
  while (!this->Samples.empty() && this->Samples.front().Time < this->Samples.back().Time - Span)
  {
    this->Samples.pop_front();
  }
}

void pqHapticsForceChart::draw()
{
  if (!this->IsOld || !this->Widget->isVisible() ||
    (this->SinceDrawing.isValid() && this->SinceDrawing.elapsed() < DrawInterval))
  {
    return;
  }
  this->SinceDrawing.start();
  this->IsOld = false;
  this->Table->SetNumberOfRows(static_cast<vtkIdType>(this->Samples.size()));
  double largest = 0.0;
  for (std::size_t i = 0; i < this->Samples.size(); ++i)
  {
    this->Table->SetValue(static_cast<vtkIdType>(i), 0, this->Samples[i].Time);
    this->Table->SetValue(static_cast<vtkIdType>(i), 1, this->Samples[i].Force);
    largest = std::max(largest, this->Samples[i].Force);
  }
  this->Table->Modified();
  const bool hasLine = this->Samples.size() > 1; // no line has fewer points
  this->Chart->GetPlot(0)->SetVisible(hasLine);
  this->Chart->SetTitle(hasLine ? "" : EmptyTitle);
  const double end = this->Samples.empty() ? 0.0 : this->Samples.back().Time;
  const double limit =
    this->Scene ? this->Scene->GetServo()->GetEffectiveMaximumForce() : UnlimitedForce;
  const bool isLimited = limit > 0.0 && limit < VTK_DOUBLE_MAX;
  const double top = isLimited ? limit : UnlimitedForce;
  const double range[2] = { std::max(end - Span, 0.0), std::max(end, Span) };
  for (int i = 0; i < 2; ++i)
  {
    this->LimitTable->SetValue(i, 0, range[i]);
    this->LimitTable->SetValue(i, 1, top);
  }
  this->LimitTable->Modified();
  this->Chart->GetPlot(1)->SetOpacity(isLimited ? 1.0 : 0.0);
  this->Chart->GetAxis(vtkAxis::BOTTOM)->SetRange(range[0], range[1]);
  this->Chart->GetAxis(vtkAxis::LEFT)->SetRange(0.0, Headroom * std::max(top, largest));
  this->View->GetScene()->SetDirty(true);
  this->Widget->renderWindow()->Render();
}
