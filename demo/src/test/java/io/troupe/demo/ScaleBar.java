package io.troupe.demo;

import org.w3c.dom.Element;

/** The scale of a map as read from the picture: length of the bar and the number beside it. */
record ScaleBar(double lengthPx, double metres) {
    ScaleBar(Element svg) {
        this(length(svg), Double.parseDouble(label(svg).replace(" m", "")));
    }

    private static double length(Element svg) {
        var line = (Element) first(svg, "g").getElementsByTagName("line").item(0);
        return Double.parseDouble(line.getAttribute("x2")) - Double.parseDouble(line.getAttribute("x1"));
    }

    private static String label(Element svg) {
        return first(svg, "text").getTextContent();
    }

    private static Element first(Element svg, String name) {
        var found = svg.getElementsByTagName(name);
        for (int i = 0; i < found.getLength(); i++) {
            var each = (Element) found.item(i);
            if (each.getAttribute("class").equals("scale")) {
                return each;
            }
        }
        throw new AssertionError("no scale in the picture");
    }

    double pixelsPerMetre() {
        return lengthPx / metres;
    }
}
