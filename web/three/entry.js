export { WebGLRenderer, Scene, PerspectiveCamera, Color, BufferGeometry, BufferAttribute, Mesh, MeshLambertMaterial, MeshBasicMaterial, LineSegments, LineBasicMaterial, HemisphereLight, DirectionalLight, Raycaster, Vector2, Vector3, Matrix4, Box3, Sphere, DoubleSide } from "three";
export { OrbitControls } from "three/addons/controls/OrbitControls.js";
