"""Rendered images."""

from malus._malus import _Image


class Image:
    """A rendered image. Row 0 is the top one. Arrays are read-only views of the renderer's pixels, without a copy; they
    keep them alive."""

    def __init__(self, image: _Image):
        self._image = image

    width = property(lambda self: self._image.width, doc="Pixels per row.")
    height = property(lambda self: self._image.height, doc="Rows.")
    backend = property(lambda self: self._image.backend, doc="'embree', 'vulkan' or 'reference'.")
    device = property(lambda self: self._image.device, doc="The library or the device that rendered it.")
    trace_ms = property(lambda self: self._image.trace_ms, doc="Time of rays and shading [ms].")

    @property
    def method(self) -> str:
        """The method that rendered it. A cheaper one replaces the one that was asked for where it is exact."""
        return self._image.method

    @property
    def camera(self) -> dict:
        """The camera: "cameraToWorld" and "worldToCamera" (lists of four rows), "intrinsics" in pixels, and more
        (render/README.md, "Ground truth")."""
        return self._image.camera

    @property
    def rgb(self):
        """Radiance behind the filter, linear [W/(m^2 sr)]: float32, H x W x 3."""
        return self._image.rgb

    @property
    def stokes(self):
        """S0, S1, S2 and S3 per colour, of the light before the filter: float32, H x W x 3 x 4.

        In the frame of each pixel's ray: x to the right of the image, angles counter-clockwise, +S3 right circular
        (shaders/optics/CONVENTIONS.md). Raises malus.Error if the method has no Stokes vectors.
        """
        return self._image.stokes

    @property
    def truth(self) -> dict:
        """Ground truth by layer, of one ray through the centre of each pixel; needs render(ground_truth=True).

        All float32, H x W or H x W x 3. "Depth" and "Distance" along the axis and along the ray [m], "Position" [m],
        "Normal" and "NormalGeometric" in world space, "NormalCamera" and "NormalGeometricCamera" in the axes of the
        camera (x right, y up, z toward the viewer), "Incidence" [radians], "IndexMA" and "IndexOB" (into
        Scene.materials and Scene.meshes), "Interactions", and "Valid": 1 where the ray meets a surface. Elsewhere the
        indices are -1 and the others 0. Raises malus.Error without ground truth.
        """
        return self._image.truth

    def dolp(self):
        """Degree of linear polarization per colour: float64, H x W x 3, 0 to 1; 0 where S0 is not positive. Raises
        malus.Error if the method has no Stokes vectors."""
        return self._image.dolp()

    def aolp(self):
        """Angle of linear polarization per colour: float64, H x W x 3, radians in [0, pi), counter-clockwise from the
        image's x axis. Raises malus.Error if the method has no Stokes vectors."""
        return self._image.aolp()

    def save(self, file, *, exposure=None) -> None:
        """Writes .exr (every channel) or .png. exposure: of .png, in stops; None: the scene's. Raises malus.Error."""
        self._image.save(file, exposure)

    def __repr__(self):
        return f"<malus.Image {self.width} x {self.height}, {self.backend} {self.method}>"
