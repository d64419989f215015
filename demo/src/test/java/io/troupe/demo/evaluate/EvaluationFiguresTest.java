package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.ParsedSvg;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.demo.svg.Chart;
import io.troupe.services.subsumption.Mode;
import java.awt.image.BufferedImage;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.regex.Pattern;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class EvaluationFiguresTest {
    private static final int BLUE = 0x4477AA;
    private static final int YELLOW = 0xDDAA33;
    private static final int GREEN = 0x228833;
    private static final List<String> SUBJECTS =
            List.of(Measurement.FOLLOWER, Measurement.WANDERER, Measurement.BOTH);
    private static final String THIN_LINE = "stroke-width=\"1.2\"";

    @TempDir
    private Path out;

    private final Measurements confirming =
            SyntheticMeasurements.confirmingThePaper().measurements();

    private EvaluationFigures figures(Measurements measurements) {
        return new EvaluationFigures(SyntheticMeasurements.settings(out), measurements);
    }

    private EvaluationFigures figuresOfPromises(boolean realTime, Measurements measurements) {
        var settings = new Evaluation.Settings(
                out, 10, List.of(2), List.of(Mode.PROMISE), 1, 0, 10, false, realTime, out.resolve("log"));
        return new EvaluationFigures(settings, measurements);
    }

    private static List<String> texts(Chart chart) throws Exception {
        return ParsedSvg.parse(chart.svg()).texts();
    }

    @Test
    void everyFigureOfThePaper_saysWhatItFound_inSeconds() throws Exception {
        var charts = figures(confirming).charts();

        assertThat(charts.keySet())
                .containsExactly("evaluation-15", "evaluation-18", "evaluation-21", "evaluation-22", "evaluation-23");
        assertThat(texts(charts.get("evaluation-15")))
                .contains("sync: both services take 8 s, the wall follower 4 s and the space wanderer 1 s")
                .contains("JVM with 2 cores", "JVM with 3 cores", "Simulated time, s for 1000 loops");
        String title = "Both services take: sync 8 s, callback 4.01 s, promise 4 s";
        assertThat(texts(charts.get("evaluation-23")))
                .contains(title, "Figure 23 of the paper, 1000 loops of each service, on a JVM with 3 cores")
                .contains("sync", "callback", "promise", "8", "4.01", "4");
        assertThat(ParsedSvg.parse(charts.get("evaluation-23").svg()).title()).isEqualTo(title);
    }

    @Test
    void files_arePicturesWithBarsAsHighAsTheNumbers() throws Exception {
        var names = figures(confirming).write(out);
        assertThat(names).hasSize(5);
        for (String name : names) {
            var svg = Files.readString(out.resolve(name + ".svg"));
            assertThat(svg).contains("#ddaa33").doesNotContain("NaN");
            ParsedSvg.parse(svg);
        }
        BufferedImage all = ImageIO.read(out.resolve("evaluation-23.png").toFile());
        int left = all.getWidth() / 2;
        // the tallest column of a colour on the left is the bar of both services: 8, 4.01 and 4 s
        int sync = tallest(all, left, BLUE);
        assertThat(sync).isGreaterThan(100);
        assertThat(tallest(all, left, YELLOW) / (double) sync).isBetween(0.47, 0.53);
        assertThat(tallest(all, left, GREEN) / (double) sync).isBetween(0.47, 0.53);
    }

    private static int tallest(BufferedImage image, int width, int colour) {
        int tallest = 0;
        for (int x = 0; x < width; x++) {
            int height = 0;
            for (int y = 0; y < image.getHeight(); y++) {
                height = (image.getRGB(x, y) & 0xFFFFFF) == colour ? height + 1 : 0;
                tallest = Math.max(tallest, height);
            }
        }
        return tallest;
    }

    @Test
    void whatWasMeasuredOnce_hasNoSpread() throws Exception {
        var once = new Measurements();
        var often = new Measurements();
        for (int repetition = 1; repetition <= 5; repetition++) {
            for (var each : confirming.all()) {
                double value = each.value() * repetition;
                var varied = new Measurement(
                        each.kind(), each.mode(), each.cores(), repetition, each.subject(), each.quantity(), value);
                often.add(varied);
                if (repetition == 1) {
                    once.add(varied);
                }
            }
        }
        var single = figuresOfPromises(true, once).charts().get("evaluation-21");
        var repeated = figures(often).charts().get("evaluation-21");

        assertThat(texts(single)).contains("Computing time, µs for a loop, measured once");
        assertThat(single.svg()).doesNotContain(THIN_LINE);
        assertThat(repeated.svg()).contains(THIN_LINE);
    }

    /** {@code -Dfigures=write} writes the documented figures. */
    @Test
    void picturesInTheDocumentation_areThoseOfTheTableThere() throws Exception {
        String guide = Files.readString(Path.of("..", "docs", "guide", "11-measurements.md"));
        var charts = figures(documented(guide)).charts();

        for (int figure : new int[] {15, 22, 23}) {
            String name = "evaluation-" + figure;
            Path file = Path.of("..", "docs", "figures", name + ".svg");
            if ("write".equals(System.getProperty("figures"))) {
                Files.writeString(file, charts.get(name).svg());
            }
            assertThat(file).hasContent(charts.get(name).svg());
            assertThat(guide).contains("(../figures/" + name + ".svg)");
        }
    }

    /** Five repetitions with the documented medians and quartiles. */
    private static Measurements documented(String guide) {
        var measurements = new Measurements();
        String spread = " +([\\d.]+) \\(([\\d.]+?)\\.\\.([\\d.]+)\\) +\\|";
        var row = Pattern.compile("(?m)^\\| (\\w+) +\\| (\\d) +\\| ([\\d.]+) s +\\|" + spread + spread + spread)
                .matcher(guide);
        var alone = Pattern.compile("by themselves ([\\d.]+) s and ([\\d.]+) s").matcher(guide);
        assertThat(alone.find()).isTrue();
        while (row.find()) {
            Mode mode = Mode.valueOf(row.group(1).toUpperCase(Locale.ROOT));
            int cores = Integer.parseInt(row.group(2));
            for (int repetition = 1; repetition <= 5; repetition++) {
                for (int column = 0; column < 3; column++) {
                    String subject = SUBJECTS.get(column);
                    int group = 4 + 3 * column + (repetition < 3 ? 1 : repetition == 3 ? 0 : 2);
                    double seconds = Double.parseDouble(column == 2 ? row.group(3) : alone.group(column + 1));
                    double micros = Double.parseDouble(row.group(group));
                    var computing = column == 2 ? Quantity.TURN : Quantity.CYCLE;
                    measurements.add(new Measurement(
                            Kind.LOOPS, mode, cores, repetition, subject, Quantity.TIME, 1000 * seconds));
                    measurements.add(
                            new Measurement(Kind.LOOPS, mode, cores, repetition, subject, computing, micros));
                }
            }
        }
        assertThat(measurements.all()).hasSize(6 * 5 * 3 * 2);
        return measurements;
    }

    @Test
    void modesThatWereNotMeasured_haveNoFigure() {
        assertThat(figuresOfPromises(false, confirming).charts()).containsOnlyKeys("evaluation-21");
    }
}
