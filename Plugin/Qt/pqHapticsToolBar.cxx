#include "pqHapticsToolBar.h"

#include "pqHapticsActions.h"

pqHapticsToolBar::pqHapticsToolBar(QWidget* parent)
  : Superclass("Haptics", parent)
{
  this->setObjectName("HapticsToolBar");
  this->addActions(pqHapticsActions::instance()->ofToolBar());
}
