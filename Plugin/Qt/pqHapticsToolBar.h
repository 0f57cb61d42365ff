/**
 * @class   pqHapticsToolBar
 * @brief   One button, Touch: feel the selected source.
 *
 * Pressed, it shows the selected source as a Haptic Surface in the active view and engages the
 * device that was used last, the mouse where there is none. It stays pressed in while the hand is
 * engaged; pressed again it releases the hand. GUI thread.
 *
 * @sa pqHapticsManager pqHapticsPanel
 */
#ifndef Haptics_pqHapticsToolBar_h
#define Haptics_pqHapticsToolBar_h

#include <QToolBar>

class pqHapticsToolBar : public QToolBar
{
  Q_OBJECT
  using Superclass = QToolBar;

public:
  pqHapticsToolBar(QWidget* parent = nullptr);
  ~pqHapticsToolBar() override = default;

private:
  Q_DISABLE_COPY(pqHapticsToolBar)
};

#endif
