#ifndef Haptics_RemedyTestTools_h
#define Haptics_RemedyTestTools_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

/// What an object reports, errors and warnings, while this is there.
class Messages
{
public:
  explicit Messages(vtkObject* object)
    : Reporter(object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto* const messages = static_cast<Messages*>(self);
        messages->Text += text ? static_cast<const char*>(text) : "";
        ++messages->Count;
      });
    object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  ~Messages() { this->Reporter->RemoveObserver(this->Command); }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  std::string Text;
  int Count = 0;

private:
  vtkSmartPointer<vtkObject> Reporter;
  vtkNew<vtkCallbackCommand> Command;
};

/// `call` makes `reporter` say `words`; after `remedy` it says nothing.
inline void ExpectRemedy(vtkObject* reporter, const std::string& words,
  const std::function<void()>& call, const std::function<void()>& remedy)
{
  {
    Messages messages(reporter);
    call();
    EXPECT_NE(messages.Text.find(words), std::string::npos)
      << '"' << words << "\" is not in: " << messages.Text;
    EXPECT_EQ(messages.Count, 1) << words << ": " << messages.Text;
  }
  Messages messages(reporter);
  remedy();
  messages.Text.clear();
  messages.Count = 0;
  call();
  EXPECT_EQ(messages.Count, 0) << words << ": " << messages.Text;
}

#endif
