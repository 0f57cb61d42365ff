/**
 * @class   pqHapticsHelp
 * @brief   What the plugin adds to the menu Help: its tutorial.
 *
 * @sa pqHapticsActions
 */
#ifndef Haptics_pqHapticsHelp_h
#define Haptics_pqHapticsHelp_h

#include <QActionGroup>

class pqHapticsHelp : public QActionGroup
{
  Q_OBJECT
  using Superclass = QActionGroup;

public:
  explicit pqHapticsHelp(QObject* parent);
  ~pqHapticsHelp() override = default;

private:
  Q_DISABLE_COPY(pqHapticsHelp)
};

#endif
