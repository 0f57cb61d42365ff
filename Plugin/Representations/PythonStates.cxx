#include "PythonStates.h"

#if VTK_MODULE_ENABLE_VTK_PythonInterpreter
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPythonInterpreter.h"

#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <dlfcn.h>
#include <string>

namespace haptics
{
namespace
{
/// Importing paraview.simple takes a second, so the package is imported when a state is asked for.
constexpr const char* Extension = R"python(
def _extend_haptics(folder):
    import importlib.machinery
    import sys

    if folder not in sys.path:
        sys.path.append(folder)

    class Finder:
        def find_spec(self, name, path=None, target=None):
            if name != "paraview.smstate":
                return None
            sys.meta_path.remove(self)
            spec = importlib.machinery.PathFinder.find_spec(name, path)
            if spec and spec.loader:
                execute = spec.loader.exec_module

                def exec_module(module):
                    execute(module)
                    import vtkhaptics.paraview

                spec.loader.exec_module = exec_module
            return spec

    if "paraview.smstate" in sys.modules:
        import vtkhaptics.paraview
    else:
        sys.meta_path.insert(0, Finder())


)python";

/// Safe in the text of a program, whatever a path is made of.
std::string Hexadecimal(const std::string& text)
{
  std::string digits;
  for (const unsigned char byte : text)
  {
    char two[3];
    std::snprintf(two, sizeof(two), "%02x", byte);
    digits += two;
  }
  return digits;
}

/// Where the package was installed, or built, with this library.
std::string PackageFolder()
{
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&ExtendPython), &library) == 0 || !library.dli_fname)
  {
    return std::string();
  }
  return vtksys::SystemTools::CollapseFullPath(HAPTICS_PYTHON_FROM_PLUGIN,
    vtksys::SystemTools::GetFilenamePath(vtksys::SystemTools::GetRealPath(library.dli_fname)));
}

void Run()
{
  const std::string folder = PackageFolder();
  if (vtksys::SystemTools::FileExists(folder + "/vtkhaptics/paraview.py", true))
  {
    const std::string call = "_extend_haptics(bytes.fromhex('" + Hexadecimal(folder) +
      "').decode())\ndel _extend_haptics\n";
    vtkPythonInterpreter::RunSimpleString((Extension + call).c_str());
  }
}
}

void ExtendPython()
{
  static const vtkNew<vtkPythonInterpreter> interpreter; // an observer of all of Python
  static bool isDone = false;
  if (!isDone)
  {
    isDone = true;
    if (vtkPythonInterpreter::IsInitialized())
    {
      Run();
    }
    else
    {
      vtkNew<vtkCallbackCommand> whenThere;
      whenThere->SetCallback([](vtkObject*, unsigned long, void*, void*) { Run(); });
      interpreter->AddObserver(vtkCommand::EnterEvent, whenThere);
    }
  }
}
}

#else
namespace haptics
{
void ExtendPython() {}
}
#endif
