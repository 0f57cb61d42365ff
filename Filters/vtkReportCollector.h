/**
 * @class   vtkReportCollector
 * @brief   collects the errors and warnings that objects report while a call is under way
 *
 * The Python package raises what its objects report (vtkhaptics/errors.py). One C++ observer for
 * all of them does it: VTK keeps a list of every observer that Python has made, and goes through
 * it whenever one is added or deleted, so that observers in Python cost more with each object.
 *
 * A call begins by Begin() and ends by End(); calls nest, each thread has its own. What a watched
 * object reports in between, in the same thread, is collected for the innermost; what it reports
 * outside of any call goes to VTK's output window, as if it had no observer.
 *
 * All methods are static and for any thread; those that read reports are for the thread of End().
 *
 * @sa vtkObject vtkOutputWindow
 */

#ifndef Haptics_vtkReportCollector_h
#define Haptics_vtkReportCollector_h

#include "vtkHapticsFiltersModule.h"
#include "vtkObject.h"

class VTKHAPTICSFILTERS_EXPORT vtkReportCollector : public vtkObject
{
public:
  static vtkReportCollector* New();
  vtkTypeMacro(vtkReportCollector, vtkObject);

  /// Collects what an object reports, from now on. It does not keep the object; once is enough.
  static void Watch(vtkObject* reporter);

  /**
   * Whether the program handles an object's vtkCommand::ErrorEvent or WarningEvent by an observer
   * of its own. What it handles is collected as such, and goes to no output window. Default: false.
   */
  static void SetHandled(vtkObject* reporter, unsigned long event, bool isHandled);

  /// Begins a call of an object, and watches that.
  static void Begin(vtkObject* called);

  /// Ends the call that was begun last; returns how many reports came, which can be read until the
  /// next End().
  static int End();

  ///@{
  /// A report of the call that ended last, from 0 in the order in which they came: the object, null
  /// where that was being deleted, its words, and what it is. Out of range: null, "", false.
  static vtkObject* GetReporter(int index);
  static const char* GetText(int index);
  static bool IsError(int index);
  static bool IsHandled(int index);
  ///@}

protected:
  vtkReportCollector() = default;
  ~vtkReportCollector() override = default;

private:
  vtkReportCollector(const vtkReportCollector&) = delete;
  void operator=(const vtkReportCollector&) = delete;
};

#endif
