"""The glossary: terms of the page, explained in one list and wherever `term` marks them."""
import html

from markupsafe import Markup

kTerms = {
    "time": "Tracing only, one sample per round. Methods are interleaved, so that other load on the machine affects all "
            "of them. On vulkan the device’s timestamps are used. Build, upload, compilation and read-back are separate.",
    "/ schlick": "Median and quartiles of the ratio to schlick in the same round.",
    "quartiles": "A quarter of the rounds is below the first number, and a quarter above the second.",
    "no significant difference": "A paired sign test over the rounds does not reject equality at 5 %. It needs at least six "
                                 "rounds.",
    "Pareto front": "The methods and choices for which no other one is both as fast and as accurate.",
    "error of the method": "Difference from the exact method, stokes, on the same renderer, which traces the same rays.",
    "error of the precision": "Difference of the exact method in single precision from the double-precision reference.",
    "rel. RMS": "Root of the summed squared differences over the summed squared reference, over pixels and colours.",
    "error > 1 %": "Share of pixels with a colour whose error exceeds 1 % of the reference, or of 0.001 of its mean if that "
                   "is larger.",
    "FLIP": "Mean perceived difference of the two displayed images when alternating between them, 0 to 1 (Andersson et "
            "al. 2020).",
    "mean, maximum": "Absolute difference of radiance.",
    "energy": "Sum over the image relative to the reference. A method with a value above 1 creates light.",
    "payload": "The bytes that a ray returns: intensity, and with it the polarization that the method carries.",
    "DoLP": "Degree of linear polarization: the share of the light that a polarizer at the right angle removes, 0 to 1.",
    "AoLP": "Angle of linear polarization: the direction in which the field oscillates, counter-clockwise from the image’s "
            "x axis.",
    "Mray/s": "Million rays per second.",
    "location": "“Mostly in the lower left”: at least half of the pixels with an error above 1 % are in that ninth of the "
                "image, or 60 % in that third.",
}


def term(name: str, shown: str = None) -> Markup:
    """Returns the term with its explanation on hover and for screen readers."""
    return Markup(f'<abbr title="{html.escape(kTerms[name])}">{html.escape(shown or name)}</abbr>')
