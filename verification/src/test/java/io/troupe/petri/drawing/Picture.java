package io.troupe.petri.drawing;

import static java.util.stream.Collectors.toMap;
import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.StringReader;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;
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
            var source = new InputSource(new StringReader(svg));
            root = DocumentBuilderFactory.newInstance()
                    .newDocumentBuilder()
                    .parse(source)
                    .getDocumentElement();
        } catch (SAXException | ParserConfigurationException | IOException notWellFormed) {
            throw new AssertionError(svg, notWellFormed);
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
        var shape = word.equals("place") ? "circle" : "rect";
        return groups(word).stream()
                .collect(toMap(
                        group -> texts(group).getFirst(),
                        group -> first(group, shape).getAttribute("fill")));
    }

    /** The length in pixels of a straight line between the points in the path's data. */
    static double lengthOfFirstPath(Element group) {
        var numbers = numbers(first(group, "path").getAttribute("d"));
        var length = 0.0;
        for (var i = 2; i + 1 < numbers.length; i += 2) {
            length += Math.hypot(numbers[i] - numbers[i - 2], numbers[i + 1] - numbers[i - 1]);
        }
        return length;
    }

    private static double[] numbers(String text) {
        var numbers = Arrays.stream(text.split("[^0-9.-]+")).filter(number -> !number.isEmpty());
        return numbers.mapToDouble(Double::parseDouble).toArray();
    }

    Box viewBox() {
        var numbers = numbers(attribute("viewBox"));
        return new Box(numbers[0], numbers[1], numbers[2], numbers[3]);
    }

    /** The groups that have this word as one of their classes. */
    List<Element> groups(String word) {
        return elements(root, "g").stream().filter(group -> isOf(group, word)).toList();
    }

    static boolean isOf(Element group, String word) {
        return List.of(group.getAttribute("class").split(" ")).contains(word);
    }

    List<String> titles(String word) {
        return groups(word).stream().map(Picture::title).toList();
    }

    /** The titles of those groups that are coloured as parts of the path. */
    List<String> coloured(String word) {
        return groups(word).stream()
                .filter(group -> isOf(group, "path"))
                .map(Picture::title)
                .toList();
    }

    static String title(Element element) {
        return first(element, "title").getTextContent();
    }

    static List<String> texts(Element group) {
        return elements(group, "text").stream().map(Element::getTextContent).toList();
    }

    static List<Element> elements(Element from, String name) {
        var nodes = from.getElementsByTagName(name);
        return IntStream.range(0, nodes.getLength())
                .mapToObj(i -> (Element) nodes.item(i))
                .toList();
    }

    private static Element first(Element from, String name) {
        return elements(from, name).getFirst();
    }

    /** The extent of the first circle of the group, or of its first rectangle if it has none. */
    static Box box(Element group) {
        if (!elements(group, "circle").isEmpty()) {
            return circle(first(group, "circle"));
        }
        var rect = first(group, "rect");
        var x = number(rect, "x");
        var y = number(rect, "y");
        return new Box(x, y, x + number(rect, "width"), y + number(rect, "height"));
    }

    static Box circle(Element circle) {
        var x = number(circle, "cx");
        var y = number(circle, "cy");
        var r = number(circle, "r");
        return new Box(x - r, y - r, x + r, y + r);
    }

    private static double number(Element element, String attribute) {
        return Double.parseDouble(element.getAttribute(attribute));
    }

    /** Asserts that these nodes are visible and do not overlap. */
    void requireApart(List<Element> nodes, String what) {
        var boxes = nodes.stream().map(Picture::box).toList();
        for (var i = 0; i < boxes.size(); i++) {
            var node = what + ": " + title(nodes.get(i));
            assertThat(viewBox().contains(boxes.get(i))).as(node + " is inside").isTrue();
            for (var j = 0; j < i; j++) {
                assertThat(boxes.get(i).overlaps(boxes.get(j)))
                        .as(node + " overlaps " + title(nodes.get(j)))
                        .isFalse();
            }
        }
    }
}
