package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Mode;
import java.awt.image.BufferedImage;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import javax.imageio.ImageIO;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.knowm.xchart.CategorySeries;

class FiguresTest {
    private static final int BLUE = 0x4477AA;
    private static final int YELLOW = 0xDDAA33;
    private static final int GREEN = 0x228833;

    @TempDir
    private Path out;

    private Figures figures(MadeUp made) {
        return new Figures(MadeUp.settings(out), made.measurements());
    }

    @Test
    void everyFigureOfThePaper_hasItsBars() {
        var charts = figures(MadeUp.asThePaperSays()).charts();
        assertThat(charts.keySet())
                .containsExactly("evaluation-15", "evaluation-18", "evaluation-21", "evaluation-22", "evaluation-23");
        assertThat(charts.get("evaluation-15").getFirst().getSeriesCollection())
                .extracting(CategorySeries::getName)
                .containsExactly("told 2 cores", "told 3 cores");
        var time = charts.get("evaluation-23").getFirst();
        assertThat(time.getSeriesCollection())
                .extracting(CategorySeries::getName)
                .containsExactly("sync", "callback", "promise");
        assertThat(time.getSeries("sync").getYData()).containsExactly(4000, 1000, 8000);
        assertThat(charts.get("evaluation-22").getLast().getSeries("promise").getYData())
                .containsExactly(4000, 1000, 4000);
    }

    @Test
    void files_arePicturesWithBarsAsHighAsTheNumbers() throws Exception {
        var names = figures(MadeUp.asThePaperSays()).write(out);
        assertThat(names).hasSize(5);
        for (String name : names) {
            var svg = Files.readString(out.resolve(name + ".svg"));
            assertThat(svg).contains("rgb(221,170,51)").doesNotContain("NaN");
            var parsed = DocumentBuilderFactory.newInstance();
            parsed.setFeature("http://apache.org/xml/features/nonvalidating/load-external-dtd", false);
            assertThat(parsed.newDocumentBuilder()
                            .parse(out.resolve(name + ".svg").toFile())
                            .getDocumentElement()
                            .getTagName())
                    .isEqualTo("svg");
        }
        BufferedImage all = ImageIO.read(out.resolve("evaluation-23.png").toFile());
        int left = all.getWidth() / 2;
        // the longest column of a colour on the left is the bar of both services: 8000, 4010 and 4000 ms
        int sync = tallest(all, left, BLUE);
        assertThat(sync).isGreaterThan(100);
        assertThat(tallest(all, left, YELLOW) / (double) sync).isBetween(0.48, 0.52);
        assertThat(tallest(all, left, GREEN) / (double) sync).isBetween(0.48, 0.52);
    }

    private static int tallest(BufferedImage image, int width, int colour) {
        int tallest = 0;
        for (int x = 0; x < width; x++) {
            int height = 0;
            for (int y = 0; y < image.getHeight(); y++) {
                height += (image.getRGB(x, y) & 0xFFFFFF) == colour ? 1 : 0;
            }
            tallest = Math.max(tallest, height);
        }
        return tallest;
    }

    @Test
    void whatWasMeasuredOnce_hasNoSpread() {
        var once = new EvaluationSettings(
                out, 10, List.of(2), List.of(Mode.PROMISE), 1, 0, 10, false, true, out.resolve("log"));
        var charts = new Figures(once, MadeUp.asThePaperSays().measurements()).charts();
        var computing = charts.get("evaluation-21").getLast();
        assertThat(computing.getYAxisTitle()).endsWith("measured once");
        assertThat(computing.getSeries("told 2 cores").getExtraValues()).isNull();
        assertThat(figures(MadeUp.asThePaperSays())
                        .charts()
                        .get("evaluation-21")
                        .getLast()
                        .getSeries("told 2 cores")
                        .getExtraValues())
                .isNotNull();
    }

    @Test
    void modesThatWereNotMeasured_haveNoFigure() {
        var settings = new EvaluationSettings(
                out, 10, List.of(2), List.of(Mode.PROMISE), 1, 0, 10, false, false, out.resolve("log"));
        var charts = new Figures(settings, MadeUp.asThePaperSays().measurements()).charts();
        assertThat(charts.keySet()).containsExactly("evaluation-21");
    }
}
