package io.troupe.sim.scenario;

import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/**
 * A world for any number of robots: square halls of 16 m, each with inner walls, three colours, or as many as one
 * likes, and up to 64 robots.
 *
 * <p><b>Role.</b> The load of benchmarks and of runs with many robots. The text is in the classic dialect and needs no
 * other file, so that real Stage loads it too. The robots are called {@code robot1}, {@code robot2}, ..; each is a
 * Pioneer 2DX with sixteen sonars and a camera.
 *
 * <p><b>Units and shapes.</b> The halls form a square around the origin. A hall is filled before the next one gets a
 * robot.
 */
public final class CrowdWorld {
    /** The length of a hall's side, from the middle of one wall to the middle of the opposite one. */
    public static final double HALL_M = 16;

    public static final int MOST_ROBOTS_PER_HALL = 64;
    public static final int MOST_ROBOTS = 20_000;

    public static final int MOST_COLOURS = 100;

    private static final int WALLS_PER_HALL = 4;
    private static final double PANELLED_M = 15; // of each wall
    private static final double PANEL_M = 1;
    private static final double PANEL_GAP_M = 0.2;
    private static final int ROBOTS_PER_ROW = 8;
    private static final double ROBOT_SPACING_M = 1.8;
    private static final int TURN_DEG = 137; // neighbours look in different directions

    private static final String DEFINITIONS = """
            interval_sim 100
            resolution 0.02

            define wall model ( color "black" )
            define panel model ( size [ 1.0 0.1 0.5 ] )

            define pioneer position
            (
              size [ 0.44 0.33 0.22 ]
              origin [ -0.04 0 0 0 ]
              mass 23
              drive "diff"
              localization "gps"
              block
              (
                points 8
                point[0] [ -0.2 0.12 ] point[1] [ -0.2 -0.12 ] point[2] [ -0.12 -0.2555 ] point[3] [ 0.12 -0.2555 ]
                point[4] [ 0.2 -0.12 ] point[5] [ 0.2 0.12 ] point[6] [ 0.12 0.2555 ] point[7] [ -0.12 0.2555 ]
                z [ 0 0.22 ]
              )
              ranger
              (
                scount 16
                spose[0] [ 0.075 0.130 90 ] spose[1] [ 0.115 0.115 50 ]
                spose[2] [ 0.150 0.080 30 ] spose[3] [ 0.170 0.025 10 ]
                spose[4] [ 0.170 -0.025 -10 ] spose[5] [ 0.150 -0.080 -30 ]
                spose[6] [ 0.115 -0.115 -50 ] spose[7] [ 0.075 -0.130 -90 ]
                spose[8] [ -0.155 -0.130 -90 ] spose[9] [ -0.195 -0.115 -130 ]
                spose[10] [ -0.230 -0.080 -150 ] spose[11] [ -0.250 -0.025 -170 ]
                spose[12] [ -0.250 0.025 170 ] spose[13] [ -0.230 0.080 150 ]
                spose[14] [ -0.195 0.115 130 ] spose[15] [ -0.155 0.130 90 ]
                sview [ 0 5.0 15 ]
                ssize [ 0.01 0.05 ]
              )
              blobfinder ( image [ 80 60 ] range 2.0 fov 60%s )
            )

            """;

    private final int robots;
    private final List<String> colours; // none: the three panels it always had
    private final int hallsPerSide;
    private final StringBuilder text = new StringBuilder();

    private CrowdWorld(int robots, List<String> colours) {
        this.robots = robots;
        this.colours = colours;
        int halls = (robots + MOST_ROBOTS_PER_HALL - 1) / MOST_ROBOTS_PER_HALL;
        hallsPerSide = (int) Math.ceil(Math.sqrt(halls));
    }

    /** The world file. */
    public static String text(int robots) {
        return text(robots, List.of());
    }

    /**
     * The world file with panels of so many colours along the walls of each hall, which are also what the cameras
     * report.
     *
     * @param colours from 1 to {@value #MOST_COLOURS}
     */
    public static String text(int robots, int colours) {
        return text(robots, names(colours));
    }

    private static String text(int robots, List<String> colours) {
        if (robots < 1 || robots > MOST_ROBOTS) {
            throw new IllegalArgumentException("a crowd has " + robots + " robots, expected from 1 to " + MOST_ROBOTS);
        }
        var crowd = new CrowdWorld(robots, colours);
        crowd.write();
        return crowd.text.toString();
    }

    private static List<String> names(int colours) {
        if (colours < 1 || colours > MOST_COLOURS) {
            throw new IllegalArgumentException(
                    "a crowd's halls have " + colours + " colours, expected from 1 to " + MOST_COLOURS);
        }
        return CrowdColours.names(colours);
    }

    /** The world, every robot's devices offered on port 6665 with index 0 for the first robot, 1 for the next, .. */
    public static Scenario scenario(int robots) {
        return ScenarioReader.readText(text(robots), Path.of("crowd-" + robots + ".world"));
    }

    /** The same with panels of so many colours. */
    public static Scenario scenario(int robots, int colours) {
        return ScenarioReader.readText(text(robots, colours), Path.of("crowd-" + robots + "-" + colours + ".world"));
    }

    /**
     * The colours of a hall with so many, {@code 0x00RRGGBB}: blue, red, green, and then what is as unlike all others
     * as can be, walls and robots included.
     */
    public static List<Integer> colours(int count) {
        return names(count).stream().map(Colours.byName()::get).toList();
    }

    private void write() {
        line("name \"crowd of %d\"", robots);
        text.append(String.format(Locale.ROOT, DEFINITIONS, cameraColours()));
        double side = hallsPerSide * HALL_M;
        for (int i = 0; i <= hallsPerSide; i++) {
            double at = i * HALL_M - side / 2;
            line("wall ( pose [ %.1f 0 0 0 ] size [ 0.2 %.1f 0.5 ] )", at, side + 0.2);
            line("wall ( pose [ 0 %.1f 0 0 ] size [ %.1f 0.2 0.5 ] )", at, side + 0.2);
        }
        for (int hall = 0; hall * MOST_ROBOTS_PER_HALL < robots; hall++) {
            furnish(middle(hall % hallsPerSide), middle(hall / hallsPerSide));
        }
        for (int i = 0; i < robots; i++) {
            robot(i);
        }
    }

    /** A camera that reports only what it is told to looks only where that can be. */
    private String cameraColours() {
        return colours.isEmpty()
                ? ""
                : colours.stream()
                        .map(name -> '"' + name + '"')
                        .collect(Collectors.joining(" ", " colors_count " + colours.size() + " colors [ ", " ]"));
    }

    private double middle(int hall) {
        return (hall + 0.5 - hallsPerSide / 2.0) * HALL_M;
    }

    /** Walls stand between the rows in which robots start. */
    private void furnish(double x, double y) {
        for (int column = -1; column <= 1; column++) {
            for (int row = -1; row <= 1; row += 2) {
                line(
                        "wall ( pose [ %.2f %.2f 0 0 ] size [ 0.2 2.6 0.5 ] )",
                        x + column * 2 * ROBOT_SPACING_M, y + row * 2 * ROBOT_SPACING_M);
            }
        }
        if (!colours.isEmpty()) {
            panels(x, y);
            return;
        }
        line("panel ( color \"red\" pose [ %.2f %.2f 0 0 ] )", x - 5.4, y + 7.8);
        line("panel ( color \"green\" pose [ %.2f %.2f 0 90 ] )", x + 7.8, y);
        line("panel ( color \"blue\" pose [ %.2f %.2f 0 0 ] )", x + 5.4, y - 7.8);
    }

    /** The first colour on the wall ahead, the next on the one to the right, and so on, round and round. */
    private void panels(double x, double y) {
        int perWall = (colours.size() + WALLS_PER_HALL - 1) / WALLS_PER_HALL;
        double pitchM = PANELLED_M / perWall;
        for (int i = 0; i < colours.size(); i++) {
            double along = (i / WALLS_PER_HALL + 0.5) * pitchM - PANELLED_M / 2;
            double[] place = switch (i % WALLS_PER_HALL) {
                case 0 -> new double[] {along, 7.8, 0};
                case 1 -> new double[] {7.8, -along, 90};
                case 2 -> new double[] {-along, -7.8, 0};
                default -> new double[] {-7.8, along, 90};
            };
            line(
                    "panel ( color \"%s\" size [ %.2f 0.1 0.5 ] pose [ %.2f %.2f 0 %.0f ] )",
                    colours.get(i), Math.min(PANEL_M, pitchM - PANEL_GAP_M), x + place[0], y + place[1], place[2]);
        }
    }

    private void robot(int index) {
        int hall = index / MOST_ROBOTS_PER_HALL;
        int place = index % MOST_ROBOTS_PER_HALL;
        double first = -(ROBOTS_PER_ROW - 1) / 2.0 * ROBOT_SPACING_M;
        line(
                "pioneer ( name \"robot%d\" color \"orange\" pose [ %.2f %.2f 0 %d ] )",
                index + 1,
                middle(hall % hallsPerSide) + first + place % ROBOTS_PER_ROW * ROBOT_SPACING_M,
                middle(hall / hallsPerSide) + first + place / ROBOTS_PER_ROW * ROBOT_SPACING_M,
                index * TURN_DEG % 360);
    }

    private void line(String format, Object... values) {
        text.append(String.format(Locale.ROOT, format, values)).append('\n');
    }
}
