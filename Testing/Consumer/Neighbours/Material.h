#ifndef Material_h
#define Material_h

struct Material
{
  float Shininess;
};

#endif
