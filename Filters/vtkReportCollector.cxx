#include "vtkReportCollector.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkSmartPointer.h"

#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkReportCollector);

namespace
{
struct ReportedText
{
  vtkSmartPointer<vtkObject> Reporter;
  std::string Text;
  bool IsError;
  bool IsHandled;
};

struct ThreadCalls
{
  std::vector<std::vector<ReportedText>> UnderWay; // innermost last
  std::vector<ReportedText> Ended;
};

ThreadCalls& Calls()
{
  thread_local ThreadCalls calls;
  return calls;
}

/// One for all objects whose reports the program handles, one for all others.
class ReportCommand : public vtkCommand
{
public:
  static ReportCommand* Of(bool isHandled)
  {
    static const auto handled = vtkSmartPointer<ReportCommand>::Take(new ReportCommand(true));
    static const auto other = vtkSmartPointer<ReportCommand>::Take(new ReportCommand(false));
    return isHandled ? handled : other;
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    const char* const text = data ? static_cast<const char*>(data) : "";
    const bool isError = event == vtkCommand::ErrorEvent;
    if (!Calls().UnderWay.empty())
    {
      // An object that is being deleted cannot be held.
      vtkObject* const reporter = caller && caller->GetReferenceCount() > 0 ? caller : nullptr;
      Calls().UnderWay.back().push_back({ reporter, text, isError, this->IsHandled });
    }
    else if (!this->IsHandled && isError)
    {
      vtkOutputWindow::GetInstance()->DisplayErrorText(text);
    }
    else if (!this->IsHandled)
    {
      vtkOutputWindow::GetInstance()->DisplayWarningText(text);
    }
  }

private:
  explicit ReportCommand(bool isHandled)
    : IsHandled(isHandled)
  {
  }

  bool IsHandled;
};

void Observe(vtkObject* reporter, unsigned long event)
{
  if (!reporter->HasObserver(event, ReportCommand::Of(false)) &&
    !reporter->HasObserver(event, ReportCommand::Of(true)))
  {
    reporter->AddObserver(event, ReportCommand::Of(false));
  }
}

const ReportedText& At(int index)
{
  static const ReportedText none{ nullptr, "", false, false };
  const std::vector<ReportedText>& ended = Calls().Ended;
  return index >= 0 && static_cast<std::size_t>(index) < ended.size()
    ? ended[static_cast<std::size_t>(index)]
    : none;
}
}

void vtkReportCollector::Watch(vtkObject* reporter)
{
  if (reporter)
  {
    Observe(reporter, vtkCommand::ErrorEvent);
    Observe(reporter, vtkCommand::WarningEvent);
  }
}

void vtkReportCollector::SetHandled(vtkObject* reporter, unsigned long event, bool isHandled)
{
  if (reporter && (event == vtkCommand::ErrorEvent || event == vtkCommand::WarningEvent))
  {
    reporter->RemoveObservers(event, ReportCommand::Of(!isHandled));
    if (!reporter->HasObserver(event, ReportCommand::Of(isHandled)))
    {
      reporter->AddObserver(event, ReportCommand::Of(isHandled));
    }
  }
}

void vtkReportCollector::Begin(vtkObject* called)
{
  vtkReportCollector::Watch(called);
  Calls().UnderWay.emplace_back();
}

int vtkReportCollector::End()
{
  ThreadCalls& calls = Calls();
  calls.Ended.clear();
  if (!calls.UnderWay.empty())
  {
    calls.Ended = std::move(calls.UnderWay.back());
    calls.UnderWay.pop_back();
  }
  return static_cast<int>(calls.Ended.size());
}

vtkObject* vtkReportCollector::GetReporter(int index)
{
  return At(index).Reporter;
}

const char* vtkReportCollector::GetText(int index)
{
  return At(index).Text.c_str();
}

bool vtkReportCollector::IsError(int index)
{
  return At(index).IsError;
}

bool vtkReportCollector::IsHandled(int index)
{
  return At(index).IsHandled;
}
