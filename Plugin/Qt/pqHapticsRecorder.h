/**
 * @class   pqHapticsRecorder
 * @brief   Records one run of the hand to a file.
 *
 * Armed with a file, it records from the next Engage until the hand is released, and is not armed
 * any more then: no later run writes over what one has recorded. GUI thread.
 */
#ifndef Haptics_pqHapticsRecorder_h
#define Haptics_pqHapticsRecorder_h

#include <QObject>
#include <QString>

class pqHapticsManager;

class pqHapticsRecorder : public QObject
{
  Q_OBJECT
  using Superclass = QObject;

public:
  explicit pqHapticsRecorder(pqHapticsManager* manager);
  ~pqHapticsRecorder() override = default;

  /** Whether the next run is recorded, or the one that goes on now is. */
  bool isArmed() const { return !this->file().isEmpty(); }
  /** Where to; empty where it is not armed. */
  QString file() const;
  /** What it does, in a few words. */
  QString state() const;

public Q_SLOTS:
  /**
   * Asks for a file, and before an existing one is written over; or gives it up where `on` is
   * false.
   */
  void arm(bool on);
  /** Arms it with a file; empty gives it up. */
  void setFile(const QString& file);

private:
  Q_DISABLE_COPY(pqHapticsRecorder)

  void followHand(bool engaged);

  pqHapticsManager* Manager;
  bool Recording = false;
  QString Recorded; // the last file
};

#endif
