#include "pqHapticsMenu.h"

#include "pqHapticsActions.h"

#include <QAction>

pqHapticsMenu::pqHapticsMenu(QObject* parent)
  : Superclass(parent)
{
  this->setExclusive(false);
  for (QAction* action : pqHapticsActions::instance()->all())
  {
    this->addAction(action);
  }
}
