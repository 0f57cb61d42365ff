#include "pqHapticsToolBar.h"

#include "pqHapticsManager.h"

#include <QAction>

pqHapticsToolBar::pqHapticsToolBar(QWidget* parent)
  : Superclass("Haptics", parent)
{
  this->setObjectName("HapticsToolBar");
  QAction* touch = this->addAction(QIcon(":/Haptics/Touch.svg"), "Touch");
  touch->setObjectName("actionTouch");
  touch->setCheckable(true);
  touch->setToolTip("Touch the selected source with a haptic device; press again to release it");

  pqHapticsManager* manager = pqHapticsManager::instance();
  // triggered(), not toggled(): only a user's press, not the button following the hand.
  this->connect(touch, &QAction::triggered, manager,
    [manager, touch](bool on)
    {
      on ? manager->touch() : manager->setEngaged(false);
      touch->setChecked(manager->isEngaged());
    });
  this->connect(manager, &pqHapticsManager::engagedChanged, touch, &QAction::setChecked);
}
