#include "pqHapticsHelp.h"

#include "pqHapticsActions.h"

#include <QAction>

pqHapticsHelp::pqHapticsHelp(QObject* parent)
  : Superclass(parent)
{
  this->addAction(pqHapticsActions::instance()->tutorial());
}
