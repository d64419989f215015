package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.drawing.Svg;
import java.io.StringReader;
import java.util.List;
import java.util.stream.IntStream;
import javax.xml.parsers.DocumentBuilderFactory;
import org.w3c.dom.Element;
import org.xml.sax.InputSource;

/** A picture as a reader of XML sees it. */
public record ParsedSvg(Element root) {
    public static ParsedSvg parse(String text) throws Exception {
        var source = new InputSource(new StringReader(text));
        var svg = DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(source);
        assertThat(svg.getDocumentElement().getTagName()).isEqualTo("svg");
        return new ParsedSvg(svg.getDocumentElement());
    }

    public List<Element> elements(String name) {
        var found = root.getElementsByTagName(name);
        return IntStream.range(0, found.getLength())
                .mapToObj(i -> (Element) found.item(i))
                .toList();
    }

    public List<Element> elements(String name, String attribute, String value) {
        return elements(name).stream()
                .filter(each -> each.getAttribute(attribute).equals(value))
                .toList();
    }

    public List<String> texts() {
        return elements("text").stream().map(Element::getTextContent).toList();
    }

    public static double number(Element element, String attribute) {
        return Double.parseDouble(element.getAttribute(attribute));
    }

    /** The title, after a check that screen readers get it too. */
    public String title() {
        assertThat(root.getAttribute("role")).isEqualTo("img");
        assertThat(root.getAttribute("aria-label"))
                .isEqualTo(elements("title").getFirst().getTextContent());
        return root.getAttribute("aria-label");
    }

    /** By the estimated widths of the texts. */
    public void assertWordsAreOnThePage() {
        assertThat(elements("text")).isNotEmpty().allSatisfy(text -> {
            String anchor = text.getAttribute("text-anchor");
            double part = anchor.equals("end") ? 1 : anchor.equals("middle") ? 0.5 : 0;
            double fontPx = number(text.hasAttribute("font-size") ? text : root, "font-size");
            double wide = Svg.width(text.getTextContent(), fontPx);
            double left = number(text, "x") - part * wide;
            assertThat(left).as(text.getTextContent()).isNotNegative();
            assertThat(left + wide).as(text.getTextContent()).isLessThanOrEqualTo(number(root, "width"));
            assertThat(number(text, "y")).as(text.getTextContent()).isLessThan(number(root, "height"));
        });
    }

    /** The scale of a map: length of the bar over the number beside it. */
    double pixelsPerMetre() {
        var bar = (Element) elements("g", "class", "scale")
                .getFirst()
                .getElementsByTagName("line")
                .item(0);
        String metres = elements("text", "class", "scale").getFirst().getTextContent();
        return (number(bar, "x2") - number(bar, "x1")) / Double.parseDouble(metres.replace(" m", ""));
    }
}
