/**
 * @class   pqHapticsExamples
 * @brief   The menu Haptics > Examples: small scenes to touch, made in the active view.
 *
 * Each adds its sources to the session, as a user would make them, hides in the view what it showed
 * until then, and looks at them; what can be touched is touched then. One undo takes an example
 * back, and shows again what it hid. GUI thread.
 *
 * @sa pqHapticsActions
 */
#ifndef Haptics_pqHapticsExamples_h
#define Haptics_pqHapticsExamples_h

#include <QMenu>

class pqHapticsManager;

class pqHapticsExamples : public QMenu
{
  Q_OBJECT
  using Superclass = QMenu;

public:
  pqHapticsExamples(pqHapticsManager* manager, QWidget* parent);

private:
  Q_DISABLE_COPY(pqHapticsExamples)

  void add(
    const char* name, const QString& text, const QString& tip, void (pqHapticsExamples::*make)());
  void touchAContour();
  void stiffnessByData();
  void cleanTriangles();
  void traceAPath();

  pqHapticsManager* Manager;
};

#endif
