/**
 * @class   pqHapticsMenu
 * @brief   The menu Haptics of the menu bar.
 *
 * @sa pqHapticsActions
 */
#ifndef Haptics_pqHapticsMenu_h
#define Haptics_pqHapticsMenu_h

#include <QActionGroup>

class pqHapticsMenu : public QActionGroup
{
  Q_OBJECT
  using Superclass = QActionGroup;

public:
  explicit pqHapticsMenu(QObject* parent);
  ~pqHapticsMenu() override = default;

private:
  Q_DISABLE_COPY(pqHapticsMenu)
};

#endif
