package io.troupe.petri.drawing;

import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import javax.xml.parsers.DocumentBuilderFactory;
import javax.xml.parsers.ParserConfigurationException;
import org.w3c.dom.Element;
import org.xml.sax.InputSource;
import org.xml.sax.SAXException;

/** An SVG file, parsed as XML, so that a file that is not well-formed fails here. */
final class Picture {
    /** A rectangle, or the square around a circle. */
    record Box(double left, double top, double right, double bottom) {
        boolean overlaps(Box other) {
            return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
        }

        boolean contains(Box other) {
            return left <= other.left && top <= other.top && right >= other.right && bottom >= other.bottom;
        }
    }

    private final Element root;

    Picture(String svg) {
        try {
            root = DocumentBuilderFactory.newInstance()
                    .newDocumentBuilder()
                    .parse(new InputSource(new StringReader(svg)))
                    .getDocumentElement();
        } catch (SAXException | ParserConfigurationException notWellFormed) {
            throw new AssertionError(svg, notWellFormed);
        } catch (IOException impossible) {
            throw new UncheckedIOException(impossible);
        }
    }

    String title() {
        return title(root);
    }

    String attribute(String name) {
        return root.getAttribute(name);
    }

    List<String> texts() {
        return texts(root);
    }

    /** The colours of the groups' first circles or rectangles, by the groups' first texts. */
    Map<String, String> fills(String word) {
        return groups(word).stream()
                .collect(Collectors.toMap(
                        group -> texts(group).getFirst(),
                        group -> elements(group, word.equals("place") ? "circle" : "rect")
                                .getFirst()
                                .getAttribute("fill")));
    }

    /** The length in pixels of a straight line between the points in the path's data. */
    static double lengthOfFirstPath(Element group) {
        var numbers = Arrays.stream(
                        elements(group, "path").getFirst().getAttribute("d").split("[^0-9.-]+"))
                .filter(number -> !number.isEmpty())
                .mapToDouble(Double::parseDouble)
                .toArray();
        var length = 0.0;
        for (var i = 2; i + 1 < numbers.length; i += 2) {
            length += Math.hypot(numbers[i] - numbers[i - 2], numbers[i + 1] - numbers[i - 1]);
        }
        return length;
    }

    Box viewBox() {
        var numbers = Arrays.stream(root.getAttribute("viewBox").split(" "))
                .mapToDouble(Double::parseDouble)
                .toArray();
        return new Box(numbers[0], numbers[1], numbers[2], numbers[3]);
    }

    /** The groups that have this word as one of their classes. */
    List<Element> groups(String word) {
        return elements(root, "g").stream()
                .filter(group -> List.of(group.getAttribute("class").split(" ")).contains(word))
                .toList();
    }

    List<String> titles(String word) {
        return groups(word).stream().map(Picture::title).toList();
    }

    static String title(Element element) {
        return elements(element, "title").getFirst().getTextContent();
    }

    static List<String> texts(Element group) {
        return elements(group, "text").stream().map(Element::getTextContent).toList();
    }

    static List<Element> elements(Element from, String name) {
        var nodes = from.getElementsByTagName(name);
        var found = new ArrayList<Element>();
        for (var i = 0; i < nodes.getLength(); i++) {
            found.add((Element) nodes.item(i));
        }
        return found;
    }

    /** The extent of the first rectangle or circle of the group. */
    static Box box(Element group) {
        var circles = elements(group, "circle");
        if (!circles.isEmpty()) {
            var circle = circles.getFirst();
            var x = number(circle, "cx");
            var y = number(circle, "cy");
            var r = number(circle, "r");
            return new Box(x - r, y - r, x + r, y + r);
        }
        var rect = elements(group, "rect").getFirst();
        var x = number(rect, "x");
        var y = number(rect, "y");
        return new Box(x, y, x + number(rect, "width"), y + number(rect, "height"));
    }

    static double number(Element element, String attribute) {
        return Double.parseDouble(element.getAttribute(attribute));
    }
}
