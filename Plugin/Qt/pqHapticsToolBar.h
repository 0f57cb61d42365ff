/**
 * @class   pqHapticsToolBar
 * @brief   One button, Touch: makes the selected sources touchable.
 *
 * Pressed, it makes the selected sources touchable in the active view, however they are drawn, and
 * engages the device that was used last, the mouse where there is none. It stays pressed in while
 * the selected sources are touched; pressed again it releases the hand. GUI thread.
 *
 * @sa pqHapticsActions pqHapticsManager pqHapticsPanel
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
