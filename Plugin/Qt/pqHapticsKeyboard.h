/**
 * @class   pqHapticsKeyboard
 * @brief   Brings the keyboard to the touched view, where the next key is meant for the hand
 *
 * While the hand is engaged:
 * - Return in one of the plugin's boxes, in the panel Haptics or under Touch in the Properties
 *   panel, ends the entry and gives the keyboard to the view;
 * - the space bar presses wherever the keyboard is, as long as the pointer is over the view and the
 *   mouse is the hand. Who writes text keeps it, in ParaView's boxes too; a number has no space.
 *
 * GUI thread.
 */
#ifndef Haptics_pqHapticsKeyboard_h
#define Haptics_pqHapticsKeyboard_h

#include <QObject>

class pqHapticsManager;

class pqHapticsKeyboard : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  explicit pqHapticsKeyboard(pqHapticsManager* manager);
  ~pqHapticsKeyboard() override = default;

protected:
  bool eventFilter(QObject* receiver, QEvent* event) override;

private:
  Q_DISABLE_COPY(pqHapticsKeyboard)

  bool isForHand() const;

  pqHapticsManager* Manager;
};

#endif
