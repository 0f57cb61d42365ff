/**
 * @class   pqHapticsBrush
 * @brief   Makes the cells that the hand touches ParaView's selection.
 *
 * While the action Paint Selection is on all of a stroke, while Select Touched Cell is on the last
 * one. The selection is one of cells of the touched source, by
 * their ids, as any selection in the view: it can be extracted, frozen, looked at in a SpreadSheet.
 * Data of several blocks or several server ranks have no such ids here; a message says so.
 * GUI thread.
 */
#ifndef Haptics_pqHapticsBrush_h
#define Haptics_pqHapticsBrush_h

#include "vtkType.h"

#include <QObject>
#include <QPointer>

#include <set>

class pqHapticsManager;
class pqOutputPort;

class pqHapticsBrush : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  explicit pqHapticsBrush(pqHapticsManager* manager);
  ~pqHapticsBrush() override = default;

private Q_SLOTS:
  void paint();

private:
  Q_DISABLE_COPY(pqHapticsBrush)

  void select();

  pqHapticsManager* Manager;
  QPointer<pqOutputPort> Port; // of what is painted
  std::set<vtkIdType> Cells;
};

#endif
