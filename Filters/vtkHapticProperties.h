/**
 * @class   vtkHapticProperties
 * @brief   the material of a surface: stiffness, damping, friction, texture, shading, from data or
 * constant
 *
 * Every vtkGodObjectFilter has one, and so has every surface of a vtkHapticScene. Each of the five
 * properties below is a constant, or comes from a data array of the surface, which is chosen as for
 * any filter:
 *
 *     filter->SetInputArrayToProcess(vtkHapticProperties::STIFFNESS, 0, 0,
 *       vtkDataObject::FIELD_ASSOCIATION_POINTS, "thickness");
 *     filter->GetProperties()->SetStiffnessFunction(function); // data to N/m
 *
 * Point data are interpolated over triangles, cell data are constant over each. An array's value
 * becomes the property's
 * - by a vtkPiecewiseFunction, where one is set: from the array's unit to the property's;
 * - else by a range, where one is set: the array's least value becomes the range's first, its
 *   greatest the second, the others along a straight line or a curve;
 * - else as it is.
 *
 * Errors: an array that is not there, has another size or more than one component is reported, and
 * the constant is used; where a single value is not finite or, after the mapping, out of range,
 * that place has the constant, and the first such place is reported. Textures are cut off at their
 * bounds. No force jumps: a change acts no faster than the safety lets a force grow,
 * and what softens under the hand does so over vtkHapticSafety's SoftStartTime.
 *
 * No property makes energy; haptics::SurfaceForce says how, and what that means for the hand. All
 * are in the device frame: they give the same forces at any scale. The default is none: the scene's
 * stiffness and nothing else, which costs nothing.
 *
 * All methods are for the GUI thread.
 *
 * @sa vtkGodObjectFilter vtkHapticScene haptics::SurfaceForce haptics::Friction
 */

#ifndef Haptics_vtkHapticProperties_h
#define Haptics_vtkHapticProperties_h

#include "vtkHapticsFiltersModule.h"
#include "vtkNew.h" // for vtkNew
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <array> // for std::array

#ifndef __VTK_WRAP__
#include "haptics/Material/SurfaceProperties.h" // for haptics::SurfaceProperties

#include <functional> // for std::function
#include <memory>     // for std::shared_ptr
#include <string>     // for std::string
#endif

class vtkDataArray;
class vtkImageData;
class vtkPiecewiseFunction;
class vtkPolyData;

class VTKHAPTICSFILTERS_EXPORT vtkHapticProperties : public vtkObject
{
public:
  static vtkHapticProperties* New();
  vtkTypeMacro(vtkHapticProperties, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The indices for SetInputArrayToProcess(). The same as haptics::Property.
  enum PropertyType
  {
    STIFFNESS = 0,        ///< [N/m] in the device frame; >= 0
    DAMPING = 1,          ///< [N s/m] in the device frame; >= 0
    STATIC_FRICTION = 2,  ///< pull over push at which the hand breaks away; >= 0
    DYNAMIC_FRICTION = 3, ///< pull over push while it slides; >= 0
    TEXTURE = 4,          ///< share of the force by which it is changed; -0.5 to 0.5
    NUMBER_OF_PROPERTIES = 5
  };
  /// "stiffness" and so on; empty for another number.
  static const char* GetPropertyName(int property);

  ///@{
  /**
   * @brief A property where no array gives it. Default 0; for the stiffness that means the scene's
   * own. A value out of range or not finite is an error and changes nothing.
   */
  void SetConstant(int property, double value);
  double GetConstant(int property);
  void SetStiffness(double stiffness) { this->SetConstant(STIFFNESS, stiffness); }
  double GetStiffness() { return this->GetConstant(STIFFNESS); }
  void SetDamping(double damping) { this->SetConstant(DAMPING, damping); }
  double GetDamping() { return this->GetConstant(DAMPING); }
  void SetTexture(double texture) { this->SetConstant(TEXTURE, texture); }
  double GetTexture() { return this->GetConstant(TEXTURE); }
  ///@}
  ///@{
  /**
   * @brief Friction: the god-object stays until the hand pulls by static friction times how hard it
   * presses, then slides with the dynamic one. Where the dynamic is above the static one, the
   * static one counts as that: so to set the dynamic one alone is plain Coulomb friction.
   */
  void SetStaticFriction(double friction) { this->SetConstant(STATIC_FRICTION, friction); }
  double GetStaticFriction() { return this->GetConstant(STATIC_FRICTION); }
  void SetDynamicFriction(double friction) { this->SetConstant(DYNAMIC_FRICTION, friction); }
  double GetDynamicFriction() { return this->GetConstant(DYNAMIC_FRICTION); }
  ///@}

  ///@{
  /**
   * @brief From an array's values to the property's. Null by default.
   */
  void SetFunction(int property, vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetFunction(int property);
  void SetStiffnessFunction(vtkPiecewiseFunction* f) { this->SetFunction(STIFFNESS, f); }
  void SetDampingFunction(vtkPiecewiseFunction* f) { this->SetFunction(DAMPING, f); }
  void SetStaticFrictionFunction(vtkPiecewiseFunction* f) { this->SetFunction(STATIC_FRICTION, f); }
  void SetDynamicFrictionFunction(vtkPiecewiseFunction* f)
  {
    this->SetFunction(DYNAMIC_FRICTION, f);
  }
  void SetTextureFunction(vtkPiecewiseFunction* f) { this->SetFunction(TEXTURE, f); }
  ///@}
  ///@{
  /**
   * @brief What the least and the greatest value of an array become, where there is no function.
   * Both in the property's range, in either order; anything else is an error and changes nothing.
   * None by default; an array of one value becomes the middle.
   */
  void SetRange(int property, double atLeast, double atGreatest);
  bool HasRange(int property);
  void GetRange(int property, double range[2]);
  void ClearRange(int property);
  void SetStiffnessRange(double a, double b) { this->SetRange(STIFFNESS, a, b); }
  void SetDampingRange(double a, double b) { this->SetRange(DAMPING, a, b); }
  void SetStaticFrictionRange(double a, double b) { this->SetRange(STATIC_FRICTION, a, b); }
  void SetDynamicFrictionRange(double a, double b) { this->SetRange(DYNAMIC_FRICTION, a, b); }
  void SetTextureRange(double a, double b) { this->SetRange(TEXTURE, a, b); }
  ///@}
  ///@{
  /**
   * @brief How an array goes through its range: from 0 (its least value) ... 1 (its greatest) to 0
   * ... 1 of the range. Null, the default, is a straight line. Without a range it is not looked at.
   */
  void SetCurve(int property, vtkPiecewiseFunction* curve);
  vtkPiecewiseFunction* GetCurve(int property);
  void SetStiffnessCurve(vtkPiecewiseFunction* c) { this->SetCurve(STIFFNESS, c); }
  void SetDampingCurve(vtkPiecewiseFunction* c) { this->SetCurve(DAMPING, c); }
  void SetStaticFrictionCurve(vtkPiecewiseFunction* c) { this->SetCurve(STATIC_FRICTION, c); }
  void SetDynamicFrictionCurve(vtkPiecewiseFunction* c) { this->SetCurve(DYNAMIC_FRICTION, c); }
  void SetTextureCurve(vtkPiecewiseFunction* c) { this->SetCurve(TEXTURE, c); }
  ///@}

  ///@{
  /**
   * @brief Force [N] against penetration [m], device frame, in the stiffness's place. Null by
   * default. Its first node is at 0 m and 0 N, no force is below 0; its last slope goes on beyond
   * it. Read at 257 even steps. It is scaled down as a whole where its steepest slope is more than
   * what the servo can hold. A profile that is no good is an error, and the stiffness is used.
   */
  void SetForceProfile(vtkPiecewiseFunction* profile);
  vtkPiecewiseFunction* GetForceProfile();
  ///@}
  /**
   * @brief Sets a force profile that clicks as a button does (Zilles and Salisbury 1995, end of
   * section 6): a spring of `stiffness` [N/m] up to `depth` [m], where the force drops to `drop`
   * (0 to 1) of what it was over a tenth of the depth, then the same spring again. An error where
   * stiffness or depth is not finite and above 0.
   */
  void SetForceProfileToButton(double stiffness, double depth, double drop);

  ///@{
  /**
   * @brief A picture, laid over the surface by its texture coordinates, whose grey is texture: the
   * darkest is -TextureAmplitude, the brightest +TextureAmplitude. Its first component is used, it
   * repeats beyond its borders. Null by default. It adds to TEXTURE. A surface without texture
   * coordinates is an error, and the picture is left out.
   */
  void SetTextureImage(vtkImageData* image);
  vtkImageData* GetTextureImage();
  ///@}
  ///@{
  /**
   * @brief How much the picture changes the force. Default 0.2; 0 to 0.5, other values are clamped.
   */
  void SetTextureAmplitude(double value);
  vtkGetMacro(TextureAmplitude, double);
  ///@}

  ///@{
  /**
   * @brief Whether the force follows normals that are interpolated over the triangles, so that
   * facets seem round to the hand. Default off.
   */
  vtkSetMacro(ForceShading, bool);
  vtkGetMacro(ForceShading, bool);
  vtkBooleanMacro(ForceShading, bool);
  ///@}
  ///@{
  /**
   * @brief Edges that turn by more than this stay sharp under force shading [degrees]. Default 30;
   * 0 to 180, other values are clamped.
   */
  void SetFeatureAngle(double value);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  /// The functions' and the picture's too.
  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  /// The array that is chosen for a property; null where none is. In `missing`, where one is chosen
  /// and not there, its name.
  struct ChosenArray
  {
    vtkDataArray* Array = nullptr;
    bool IsPerCell = false;
    std::string Missing;
  };
  using ArrayChoice = std::function<ChosenArray(int property)>;
  /**
   * @brief For a surface and its geometry with arrays, point for point and triangle for triangle;
   * null where the surface is plain. What is wrong is appended to `problems`.
   * `previous`: what was built for the same surface since this was changed last, or null; it is
   * returned where nothing has changed, in the arrays either. C++ only.
   */
  std::shared_ptr<const haptics::SurfaceProperties> Build(vtkPolyData* geometry,
    const haptics::TriangleSurface& surface, const ArrayChoice& choose,
    std::shared_ptr<const haptics::SurfaceProperties> previous, std::string& problems);
#endif

protected:
  vtkHapticProperties();
  ~vtkHapticProperties() override;

private:
  vtkHapticProperties(const vtkHapticProperties&) = delete;
  void operator=(const vtkHapticProperties&) = delete;

  struct Source;
  bool IsProperty(int property);
  void AddProfile(haptics::PropertyValues& values, std::string& problems);
  void AddImage(vtkPolyData* geometry, haptics::PropertyValues& values, std::string& problems);

  std::unique_ptr<std::array<Source, NUMBER_OF_PROPERTIES>> Sources;
  vtkSmartPointer<vtkPiecewiseFunction> ForceProfile;
  vtkSmartPointer<vtkImageData> TextureImage;
  double TextureAmplitude = 0.2;
  bool ForceShading = false;
  double FeatureAngle = 30.0;
};

#endif
