/**
 * @class   vtkHapticOverlay
 * @brief   Text and bars over the picture: a bar and a number of the force, a few lines, help.
 *
 * At the lower left the force as a bar and a number [N], and above them the read-out: free lines of
 * text, for a vtkHapticScene the values at the contact; between them the status, what the hand does
 * now. At the upper left the help, a list of keys, while ShowHelp is on, else the hint, a few lines
 * for the beginning. Text has a dark ground of its own, so that it can be read over any picture.
 * Where a view has no room for both, the read-out gives way to the help, and the hint to the
 * read-out.
 *
 * Needs VTK::RenderingFreeType in the program for its text. Not pickable, without bounds.
 * A vtkHapticScene keeps one up to date; it can be driven by hand as well. GUI thread.
 *
 * @sa vtkHapticScene vtkGodObjectActor
 */
#ifndef Haptics_vtkHapticOverlay_h
#define Haptics_vtkHapticOverlay_h

#include "vtkHapticsViewModule.h"
#include "vtkNew.h"
#include "vtkProp.h"

#include <array>
#include <string>

class vtkActor2D;
class vtkColorTransferFunction;
class vtkPolyData;
class vtkTextActor;

class VTKHAPTICSVIEW_EXPORT vtkHapticOverlay : public vtkProp
{
public:
  static vtkHapticOverlay* New();
  vtkTypeMacro(vtkHapticOverlay, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Strength of the force [N]. Default 0; finite and >= 0, else an error and no change. */
  void SetForce(double force);
  vtkGetMacro(Force, double);
  ///@}
  ///@{
  /**
   * Force that fills the bar [N], which the number names as well. Default 3.3; finite and > 0. A
   * vtkHapticView sets it to the largest force that the hand can meet.
   */
  void SetMaximumForce(double force);
  vtkGetMacro(MaximumForce, double);
  ///@}
  ///@{
  /** Lines above the bar. Default none. */
  void SetReadout(const std::string& text);
  std::string GetReadout() const { return this->Readout; }
  ///@}
  ///@{
  /** One line that says what the hand does, under the read-out. Default none. */
  void SetStatus(const std::string& text);
  std::string GetStatus() const { return this->Status; }
  ///@}
  ///@{
  /** Lines at the upper left, shown while ShowHelp is off. Default none. */
  void SetHint(const std::string& text);
  std::string GetHint() const { return this->Hint; }
  ///@}
  ///@{
  /** Lines at the upper left, shown while ShowHelp is on. Default none. */
  void SetHelp(const std::string& text);
  std::string GetHelp() const { return this->Help; }
  ///@}
  ///@{
  /** What is shown: the force (default on), the read-out (default on), the help (default off). */
  vtkSetMacro(ShowForce, bool);
  vtkGetMacro(ShowForce, bool);
  vtkBooleanMacro(ShowForce, bool);
  vtkSetMacro(ShowReadout, bool);
  vtkGetMacro(ShowReadout, bool);
  vtkBooleanMacro(ShowReadout, bool);
  vtkSetMacro(ShowHelp, bool);
  vtkGetMacro(ShowHelp, bool);
  vtkBooleanMacro(ShowHelp, bool);
  ///@}
  ///@{
  /**
   * Height of the text [pixel]. Default 14; 6 to 72. A picture at a multiple of the window's size
   * has it in proportion; so have views that are less than about 300 pixels high.
   */
  vtkSetClampMacro(FontSize, int, 6, 72);
  vtkGetMacro(FontSize, int);
  ///@}

  ///@{
  /** The rendering protocol of vtkProp. */
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

protected:
  vtkHapticOverlay();
  ~vtkHapticOverlay() override;

private:
  vtkHapticOverlay(const vtkHapticOverlay&) = delete;
  void operator=(const vtkHapticOverlay&) = delete;

  void Arrange(vtkViewport* viewport);
  void ArrangeBar();
  std::array<vtkActor2D*, 6> Parts() const;

  double Force = 0.0;
  double MaximumForce = 3.3;
  vtkNew<vtkColorTransferFunction> ForceColors; // to MaximumForce
  std::string Readout;
  std::string Help;
  std::string Status;
  std::string Hint;
  bool ShowForce = true;
  bool ShowReadout = true;
  bool ShowHelp = false;
  int FontSize = 14;
  double Text = 14.0; ///< height of the text in the picture that is drawn [pixel]
  double Unit = 1.0;  ///< a pixel of the window in the picture that is drawn
  double Left = 0.0;  ///< the window's lower left corner in the tile that is drawn [pixel]
  double Bottom = 0.0;

  vtkNew<vtkActor2D> GroundPart;
  vtkNew<vtkActor2D> BarPart;
  vtkNew<vtkTextActor> NumberPart;
  vtkNew<vtkTextActor> ReadoutPart;
  vtkNew<vtkTextActor> HelpPart;
  vtkNew<vtkTextActor> StatusPart;
  vtkNew<vtkPolyData> Ground;
  vtkNew<vtkPolyData> Bar;
};

#endif
