#include "pqHapticsKeyboard.h"

#include "pqHapticsManager.h"
#include "pqHapticsPanel.h"
#include "pqPropertyWidget.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QCursor>
#include <QDoubleValidator>
#include <QIntValidator>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPointer>
#include <QTimer>

#include <string>

namespace
{
template <class T>
T* ancestorOf(QWidget* widget)
{
  for (; widget; widget = widget->parentWidget())
  {
    if (auto* const found = qobject_cast<T*>(widget))
    {
      return found;
    }
  }
  return nullptr;
}

bool isBoxOfNumbers(QWidget* widget)
{
  auto* const line = qobject_cast<QLineEdit*>(widget);
  return qobject_cast<QAbstractSpinBox*>(widget) ||
    (line &&
      (qobject_cast<const QDoubleValidator*>(line->validator()) ||
        qobject_cast<const QIntValidator*>(line->validator())));
}

/// Lists have an input method too, by which they find an entry.
bool takesText(QWidget* widget)
{
  return widget && widget->testAttribute(Qt::WA_InputMethodEnabled) && !isBoxOfNumbers(widget) &&
    !qobject_cast<QAbstractItemView*>(widget);
}

/// Whether it sets what the plugin has: in its panel, or among the properties of what is touched.
bool isOfPlugin(QWidget* widget)
{
  if (ancestorOf<pqHapticsPanel>(widget))
  {
    return true;
  }
  auto* const shown = ancestorOf<pqPropertyWidget>(widget);
  vtkSMProperty* const property = shown ? shown->property() : nullptr;
  vtkSMProxy* const proxy = property ? property->GetParent() : nullptr;
  return proxy &&
    (proxy->GetXMLGroup() == std::string("haptic_properties") ||
      proxy->GetXMLName() == std::string("HapticSurfaceRepresentation"));
}
}

pqHapticsKeyboard::pqHapticsKeyboard(pqHapticsManager* manager)
  : Superclass(manager)
  , Manager(manager)
{
  QCoreApplication::instance()->installEventFilter(this);
}

/// Whether the space bar is to press, and the keyboard is elsewhere.
bool pqHapticsKeyboard::isForHand() const
{
  QWidget* const view = this->Manager->viewWidget();
  QWidget* const focus = QApplication::focusWidget();
  return view && focus != view && !takesText(focus) && this->Manager->viewDevice() &&
    view->window() == QApplication::activeWindow() && !QApplication::activePopupWidget() &&
    !QApplication::activeModalWidget() && QApplication::widgetAt(QCursor::pos()) == view;
}

bool pqHapticsKeyboard::eventFilter(QObject* receiver, QEvent* event)
{
  // The window has a key before its widget, and that of an override before that of a press: what
  // takes the keyboard here has the key too, its repetitions and its release.
  const bool isPress = event->type() == QEvent::KeyPress;
  if ((isPress || event->type() == QEvent::ShortcutOverride) && this->Manager->isEngaged())
  {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool isReturn = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
    if (key->key() == Qt::Key_Space && key->modifiers() == Qt::NoModifier && !key->isAutoRepeat() &&
      this->isForHand())
    {
      this->Manager->focusView();
    }
    else if (isPress && isReturn && isOfPlugin(qobject_cast<QWidget*>(receiver)))
    {
      const QPointer<QWidget> box = QApplication::focusWidget();
      QTimer::singleShot(0, this->Manager, // when it has taken the value
        [this, box]
        {
          if (box && box == QApplication::focusWidget())
          {
            this->Manager->focusView();
          }
        });
    }
  }
  return this->Superclass::eventFilter(receiver, event);
}
