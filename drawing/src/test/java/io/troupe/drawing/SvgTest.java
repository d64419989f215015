package io.troupe.drawing;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.ByteArrayInputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.DoubleStream;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class SvgTest {
    @Test
    void picture_isAFileOfItsElements(@TempDir Path directory) throws Exception {
        Path file = directory.resolve("lamp.svg");

        var svg = Svg.page(200, 100, 14, "A lamp");
        svg.add("<circle cx=\"%s\" cy=\"%s\" r=\"8\" fill=\"%s\"/>\n", 30.0, 50.0, Svg.colour(0xFF0000));
        svg.text(44, 55, "font-weight=\"bold\"", "on & red");
        Files.writeString(file, svg.end());

        assertThat(file).hasContent("""
                <svg xmlns="http://www.w3.org/2000/svg" width="200" height="100" viewBox="0 0 200 100" role="img" \
                aria-label="A lamp" font-family="sans-serif" font-size="14">
                <title>A lamp</title>
                <rect width="100%" height="100%" fill="white"/>
                <circle cx="30" cy="50" r="8" fill="#ff0000"/>
                <text x="44" y="55" font-weight="bold">on &amp; red</text>
                </svg>
                """);
    }

    @Test
    void text_isReadBack_inElementsAndInAttributes() throws Exception {
        String odd = "<a href=\"x\">100 % of 'b' & c</a> $1 \\";
        var svg = Svg.document(10, 10, "Helvetica, 'DejaVu Sans'", 12, odd).text(1, 1, "", odd);
        var root = DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(new ByteArrayInputStream(svg.end().getBytes(UTF_8)))
                .getDocumentElement();
        assertThat(root.getAttribute("aria-label")).isEqualTo(odd);
        assertThat(root.getTextContent().strip()).startsWith(odd).endsWith(odd);
    }

    @Test
    void places_takeTheValuesInOrder() {
        var svg = Svg.fragment().add("%s %.1f %d %s %.2f", 1.25, 2.0, 3, "%s", 0.5);
        var page = Svg.page(1, 1, 1, "t").append(svg);
        assertThat(page.end()).contains("1.3 2.0 3 %s 0.50</svg>").isEqualTo(page.end());
        assertThatThrownBy(() -> Svg.fragment().add("%s %s", "one"))
                .hasMessage("there are only 1 values for the markup %s %s");
        assertThatThrownBy(() -> Svg.fragment().add("<g>", "one"))
                .hasMessage("there are 1 values for 0 places in the markup <g>");
    }

    @Test
    void numbers_haveNoTrailingZeros_andNoNegativeZero() {
        var ones = DoubleStream.of(100, 0.04, -0.04).mapToObj(number -> Svg.number(number, 1));
        assertThat(ones).containsExactly("100", "0", "0");
        assertThat(List.of(Svg.number(1.006, 2), Svg.number(-2.5, 2), Svg.number(120, 0)))
                .containsExactly("1.01", "-2.5", "120");
        assertThat(DoubleStream.of(0.3, 1.0, 1.1, 3.0, 7.0, 20.0).map(Svg::roundStep))
                .containsExactly(0.5, 1.0, 2.0, 5.0, 10.0, 20.0);
    }

    @Test
    void ink_isReadableOnTheColour() {
        assertThat(Svg.inkOn(0x000000)).isEqualTo("white");
        assertThat(Svg.inkOn(0xFFA500)).isEqualTo("black");
        assertThat(Svg.colour(0x00FF00)).isEqualTo("#2e9f45");
    }

    @Test
    void dotLabels_showTheirText() {
        assertThat(Dot.quoted("a \"b\"\r\n\\ &lt;")).isEqualTo("\"a \\\"b\\\"\\n\\\\ &amp;lt;\"");
        assertThat(Dot.leftAligned(List.of("a\"", "b"))).isEqualTo("\"a\\\"\\lb\\l\"");
    }
}
