/**
 * @class   pqHapticsHeldKey
 * @brief   Lets a checkable action end when its key is let go, where that was held
 *
 * A short press of the action's shortcut switches it, as ever; one that is held for longer than
 * HoldTime lasts as long as the key is down. How long is what the events' own time stamps say: a
 * window that is busy gets to them late. While the action is enabled its key is its own, also where
 * a widget of ParaView has the same one.
 */
#ifndef Haptics_pqHapticsHeldKey_h
#define Haptics_pqHapticsHeldKey_h

#include <QObject>
#include <QTimer>
#include <QtGlobal>

#include <optional>

class QAction;

class pqHapticsHeldKey : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  explicit pqHapticsHeldKey(QAction* action);
  ~pqHapticsHeldKey() override = default;

  static constexpr quint64 HoldTime = 400; ///< [ms]

protected:
  bool eventFilter(QObject* receiver, QEvent* event) override;

private:
  Q_DISABLE_COPY(pqHapticsHeldKey)

  using TimeStamp = quint64;                 // of the window system [ms]
  static constexpr TimeStamp RepeatGap = 10; // [ms] of a keyboard that repeats: release to press
  static constexpr int RepeatDelay = 50;     // [ms] in which a repetition follows the release
  bool isRepeat(TimeStamp time) const;
  void press(TimeStamp time);
  void release(TimeStamp time);
  void goOn();
  void end();

  QAction* Action;
  bool IsDown = false;
  bool IsRepeated = false;             // the last event of a key, by the keyboard
  bool HasEnded = false;               // by the last release
  TimeStamp Pressed = 0;               // the last time
  std::optional<TimeStamp> Released;   // since then
  std::optional<TimeStamp> SwitchedOn; // by the key that was pressed last
  QTimer Ending{ this };
};

#endif
