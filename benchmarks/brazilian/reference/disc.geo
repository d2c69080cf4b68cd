// Quarter of a disc of radius 10, contact on the arc from 45 to 90 degrees; with plate = 1 quadrilaterals
// and a plate on the disc (CalculiX), with plate = 0 triangles and no plate (GetFEM: a rigid plane).
DefineConstant[ h = {0.1, Name "edge length at the contact"}, plate = {1, Name "plate"} ];
R = 10; s = R*Sin(Pi/4);
Point(1) = {0, 0, 0}; Point(2) = {R, 0, 0}; Point(3) = {s, s, 0}; Point(4) = {0, R, 0};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Circle(3) = {3, 1, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("disc") = {1}; Physical Line("symmetry_y") = {1}; Physical Line("symmetry_x") = {4};
Physical Line("arc") = {3};
If (plate == 1)
  Point(11) = {-1, R, 0}; Point(12) = {12, R, 0}; Point(13) = {12, R + 1, 0}; Point(14) = {-1, R + 1, 0};
  Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
  Line Loop(2) = {11:14}; Plane Surface(2) = {2};
  Transfinite Line{11, 13} = 14; Transfinite Line{12, 14} = 2; Transfinite Surface{2};
  Physical Surface("plate") = {2}; Physical Line("face") = {11};
  Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 1;
EndIf
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.2*max(10 - sqrt(x^2 + y^2) - 0.3, 0) + 0.2*max(x - 6, 0)", h);
Field[2] = MathEval; Field[2].F = "1";
Field[3] = Min; Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.CharacteristicLengthExtendFromBoundary = 0; Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6; Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
