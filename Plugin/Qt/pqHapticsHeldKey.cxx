#include "pqHapticsHeldKey.h"

#include <QAction>
#include <QCoreApplication>
#include <QKeyEvent>
#include <QShortcutEvent>

pqHapticsHeldKey::pqHapticsHeldKey(QAction* action)
  : Superclass(action)
  , Action(action)
{
  this->connect(action, &QAction::triggered, this,
    [this](bool on)
    { this->SwitchedOn = on && this->IsDown ? this->Pressed : std::optional<TimeStamp>(); });
  this->Ending.setSingleShot(true);
  this->Ending.setInterval(RepeatDelay);
  this->connect(&this->Ending, &QTimer::timeout, this, &pqHapticsHeldKey::end);
  QCoreApplication::instance()->installEventFilter(this);
}

bool pqHapticsHeldKey::eventFilter(QObject* receiver, QEvent* event)
{
  const QEvent::Type type = event->type();
  if (type == QEvent::Shortcut)
  {
    // Qt gives a key that is also one of ParaView's widgets' to neither. The hand has it while the
    // action is enabled.
    const auto* shortcut = static_cast<QShortcutEvent*>(event);
    if (shortcut->isAmbiguous() && this->Action->isEnabled() &&
      this->Action->shortcut() == shortcut->key())
    {
      if (!this->IsRepeated)
      {
        this->Action->trigger();
      }
      return true;
    }
  }
  // A key that is a shortcut is offered as an override first, and then pressed only where nobody
  // takes it.
  const bool isPress = type == QEvent::ShortcutOverride || type == QEvent::KeyPress;
  if (isPress || type == QEvent::KeyRelease)
  {
    const auto* key = static_cast<QKeyEvent*>(event);
    this->IsRepeated = key->isAutoRepeat();
    if (!key->isAutoRepeat() && this->Action->shortcut() == QKeySequence(key->key()))
    {
      if (!isPress)
      {
        this->release(key->timestamp());
      }
      else if (this->isRepeat(key->timestamp()))
      {
        this->goOn();
        event->accept(); // so that it is no shortcut
        return true;
      }
      else
      {
        this->press(key->timestamp());
      }
    }
  }
  return this->Superclass::eventFilter(receiver, event);
}

/// Whether a press is the keyboard's repetition of a key that is held, which Qt knows as such only
/// where it has read both the release and the press.
bool pqHapticsHeldKey::isRepeat(TimeStamp time) const
{
  return this->Released && time - *this->Released <= RepeatGap;
}

void pqHapticsHeldKey::press(TimeStamp time)
{
  this->IsDown = true;
  this->HasEnded = false;
  this->Pressed = time;
  this->Released.reset();
}

void pqHapticsHeldKey::release(TimeStamp time)
{
  this->IsDown = false;
  this->Released = time;
  if (this->SwitchedOn && this->Action->isChecked() && time - *this->SwitchedOn > HoldTime)
  {
    this->Ending.start(); // when no repetition comes
  }
}

void pqHapticsHeldKey::goOn()
{
  this->IsDown = true;
  this->Ending.stop();
  if (this->HasEnded)
  {
    this->HasEnded = false;
    this->Action->trigger();
  }
}

void pqHapticsHeldKey::end()
{
  if (this->SwitchedOn && this->Action->isChecked())
  {
    this->HasEnded = true;
    this->Action->trigger();
  }
}
