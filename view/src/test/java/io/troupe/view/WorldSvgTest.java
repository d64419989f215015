package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** Devices in the picture of a world, measured in it. */
class WorldSvgTest {
    private static final String MARKER = "#b03fb0";
    private static final String PRESSED = "#c62828";
    private static final String FREE = "#2e8b57";

    /** The finder is 0.2 m ahead, the marker another 1.5 m; a box is 1 cm before the bumper at the left. */
    private static final String WORLD = """
            position ( size [ 0.4 0.4 0.2 ]
              fiducial ( pose [ 0.2 0 0 0 ] range_max 5 fov 90 )
              bumper ( bcount 2 blength 0.3 bpose[0] [ 0 0.2 0 90 ] bpose[1] [ 0 -0.2 0 -90 ] ) )
            model ( pose [ 1.7 0 0 0 ] size [ 0.1 0.1 0.5 ] fiducial_return 7 )
            model ( pose [ -3 0 0 0 ] size [ 0.1 0.1 0.5 ] fiducial_return 8 )
            model ( pose [ 0 0.31 0 0 ] size [ 0.2 0.2 0.5 ] )
            """;

    private record Line(double fromX, double fromY, double toX, double toY) {
        double length() {
            return Math.hypot(toX - fromX, toY - fromY);
        }
    }

    private static List<Line> lines(String svg, String colour, String width) {
        var path = Pattern.compile("<path d=\"M([-0-9.]+)[ ,]([-0-9.]+) L([-0-9.]+)[ ,]([-0-9.]+)\" stroke=\"" + colour
                + "\" stroke-width=\"" + width + "\"/>");
        List<Line> lines = new ArrayList<>();
        var found = path.matcher(svg);
        while (found.find()) {
            lines.add(new Line(
                    Double.parseDouble(found.group(1)),
                    Double.parseDouble(found.group(2)),
                    Double.parseDouble(found.group(3)),
                    Double.parseDouble(found.group(4))));
        }
        return lines;
    }

    @Test
    void markersSeenAndBumpers_areDrawnWhereTheyAre() {
        WorldSpec world = ScenarioReader.readText(WORLD, Path.of("t.world")).world();
        String svg = new WorldSvg(
                        world, World.create(world, WorldSettings.defaults()).latest())
                .draw();
        List<Line> pressed = lines(svg, PRESSED, "3.0");
        List<Line> free = lines(svg, FREE, "3.0");
        List<Line> seen = lines(svg, MARKER, "1.2");
        assertThat(pressed).as("the box is at the left").hasSize(1);
        assertThat(free).hasSize(1);
        assertThat(seen).as("the marker behind is not seen").hasSize(1);
        double pixelsPerMetre = free.getFirst().length() / 0.3;
        assertThat(pressed.getFirst().length()).isCloseTo(0.3 * pixelsPerMetre, within(1.5));
        assertThat(free.getFirst().fromY() - pressed.getFirst().fromY())
                .as("y points down")
                .isCloseTo(0.4 * pixelsPerMetre, within(1.5));
        assertThat(seen.getFirst().length()).isCloseTo(1.5 * pixelsPerMetre, within(1.5));
        assertThat(seen.getFirst().toX()).isGreaterThan(seen.getFirst().fromX());
        assertThat(svg).contains("marker that a finder sees", "bumper, red if pressed");
    }
}
