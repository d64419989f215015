package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.device.DeviceReading;
import org.junit.jupiter.api.Test;

/** The images of cameras, worked out by hand. */
class CameraTest {
    private static final int RED = 0xFF0000;

    private static DeviceReading.Picture picture(String camera, String models) {
        var world = Specs.start("position ( size [ 0.4 0.4 0.2 ] camera ( " + camera + " ) )\n" + models);
        return (DeviceReading.Picture) Specs.first(world.latest()).devices().getFirst();
    }

    private static String row(DeviceReading.Picture picture, int row) {
        var letters = new StringBuilder();
        for (int column = 0; column < picture.columns().size(); column++) {
            letters.append(
                    switch (picture.colour(column, row)) {
                        case RED -> 'R';
                        case 0x0000FF -> 'B';
                        case DeviceReading.Picture.SKY -> '.';
                        case DeviceReading.Picture.FLOOR -> '_';
                        default -> '?';
                    });
        }
        return letters.toString();
    }

    @Test
    void image_boxesLeftAndAhead_areInTheirColumnsAndRows() {
        // 8 columns of 10 degrees: centres at 35, 25, .. -35 degrees; 10 rows of 4 degrees
        // red: face at 1.9 m, from -0.4 to 0.4: within 11.9 degrees, the columns at 5 and -5 degrees
        // its half height: atan(0.3 / (1.9 / cos 5)) = 8.9 degrees, 2 rows; blue at 25 degrees and 3.9 m: 4.3 degrees,
        // 1 row
        var picture = picture("resolution [ 8 10 ] range [ 0 6 ] fov [ 80 40 ]", """
                model ( pose [ 2 0 0 0 ] size [ 0.2 0.8 0.5 ] color "red" )
                model ( pose [ 3.625 1.690 0 25 ] size [ 0.2 0.6 0.5 ] color "blue" )
                """);
        String[] rows = {
            "........",
            "........",
            "........",
            "...RR...",
            ".B.RR...",
            "_B_RR___",
            "___RR___",
            "________",
            "________",
            "________"
        };
        for (int row = 0; row < rows.length; row++) {
            assertThat(row(picture, row)).as("row %s", row).isEqualTo(rows[row]);
        }
    }

    @Test
    void image_ofNothing_isSkyAndFloor() {
        var picture = picture("", "");
        assertThat(picture.columns()).hasSize(32);
        assertThat(row(picture, 15)).isEqualTo(".".repeat(32));
        assertThat(row(picture, 16)).isEqualTo("_".repeat(32));
    }

    @Test
    void image_ofAThingCloseBy_isFilledWithIt() {
        var picture = picture(
                "resolution [ 4 4 ] fov [ 40 30 ]", "model ( pose [ 0.5 0 0 0 ] size [ 0.2 3 0.5 ] color \"red\" )");
        for (int row = 0; row < 4; row++) {
            assertThat(row(picture, row)).isEqualTo("RRRR");
        }
        assertThat(picture.rgb()).hasSize(48).startsWith(255, 0, 0, 255, 0, 0);
    }

    @Test
    void camera_panned_looksThere() {
        String box = "model ( pose [ 0 2 0 0 ] size [ 0.8 0.2 0.5 ] color \"red\" )";
        assertThat(row(picture("resolution [ 3 3 ] fov [ 60 15 ] pantilt [ 90 0 ]", box), 1))
                .isEqualTo("_R_");
        assertThat(row(picture("resolution [ 3 3 ] fov [ 60 15 ]", box), 1)).isEqualTo("___");
    }
}
