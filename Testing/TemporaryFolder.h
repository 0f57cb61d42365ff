#ifndef TemporaryFolder_h
#define TemporaryFolder_h

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

/// An empty folder of this test alone, since tests that run together would take files from each
/// other; gone with the object, and all that is in it.
class TemporaryFolder
{
public:
  TemporaryFolder()
    : Path(Make())
  {
  }
  ~TemporaryFolder() { std::filesystem::remove_all(this->Path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string Path;
  std::string File(const std::string& name) const { return this->Path + "/" + name; }

private:
  static std::string Make()
  {
    std::string path = (std::filesystem::temp_directory_path() / "haptics-XXXXXX").string();
    if (!mkdtemp(path.data()))
    {
      throw std::runtime_error("cannot make the folder " + path);
    }
    return path;
  }
};

#endif
