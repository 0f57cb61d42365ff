/**
 * @class   pqHapticsPen
 * @brief   Draws curves on what is touched: each stroke between begin and end becomes one.
 *
 * They become one source, with force, time and the arrays of the surface along them. The picture
 * shows the trail of the hand meanwhile. A trace that is being kept goes on; else one is kept from
 * begin to end, which forgets the last one. GUI thread.
 *
 * @sa pqHapticsActions vtkHapticRecordSource
 */
#ifndef Haptics_pqHapticsPen_h
#define Haptics_pqHapticsPen_h

#include "vtkType.h"

#include <QObject>

class pqHapticsManager;

class pqHapticsPen : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  explicit pqHapticsPen(pqHapticsManager* manager);
  ~pqHapticsPen() override = default;

  bool isDrawing() const { return this->Drawing; }

public Q_SLOTS:
  /** Begins, or ends and makes the source; nothing where nothing was touched. */
  void draw(bool on);

private:
  Q_DISABLE_COPY(pqHapticsPen)

  void begin();
  void end();
  void showTrail(bool show);

  pqHapticsManager* Manager;
  bool Drawing = false;
  bool KeepsTrace = false; // for this drawing only
  vtkIdType First = 0;     // tick of the trace
};

#endif
