package io.troupe.sim.worldfile;

import io.troupe.common.text.NamedColours;
import io.troupe.sim.model.Scenario;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Collectors;

/**
 * Generates a world for any number of robots: square halls of 16 m, each with inner walls, panels in three or a given
 * number of colours, and up to 64 robots.
 *
 * <p><b>Role.</b> The load of benchmarks and of runs with many robots. The text is in the classic dialect and needs no
 * other file, so that real Stage loads it too. The robots are called {@code robot1}, {@code robot2}, ..; each is a
 * Pioneer 2DX with sixteen sonars and a camera.
 *
 * <p><b>Units and shapes.</b> The halls form a square around the origin. A hall is filled before the next one gets a
 * robot.
 */
public final class CrowdWorld {
    /** Side length of a hall, from the middle of one wall to the middle of the opposite one. */
    public static final double HALL_M = 16;

    public static final int MOST_ROBOTS_PER_HALL = 64;
    public static final int MOST_ROBOTS = 20_000;

    public static final int MOST_COLOURS = 100;

    private static final int WALLS_PER_HALL = 4;
    private static final double PANELLED_M = 15; // length of each wall that may have panels
    private static final double PANEL_M = 1;
    private static final double PANEL_GAP_M = 0.2;
    private static final int ROBOTS_PER_ROW = 8;
    private static final double ROBOT_SPACING_M = 1.8;
    private static final int TURN_DEG = 137; // neighbours face different directions

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
    private final List<String> colours; // empty: three fixed panels
    private final int hallsPerSide;
    private final StringBuilder text = new StringBuilder();

    private CrowdWorld(int robots, List<String> colours) {
        this.robots = robots;
        this.colours = colours;
        int halls = (robots + MOST_ROBOTS_PER_HALL - 1) / MOST_ROBOTS_PER_HALL;
        hallsPerSide = (int) Math.ceil(Math.sqrt(halls));
    }

    /** The text of the world file. */
    public static String text(int robots) {
        return text(robots, List.of());
    }

    /**
     * The text of the world file, with panels in the given number of colours along the walls of each hall; the cameras
     * report these colours.
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

    /**
     * The world, with the devices of all robots offered on port 6665: index 0 for the first robot, 1 for the next, and
     * so on.
     */
    public static Scenario scenario(int robots) {
        return ScenarioReader.readText(text(robots), Path.of("crowd-" + robots + ".world"));
    }

    /** The world with panels in the given number of colours. */
    public static Scenario scenario(int robots, int colours) {
        return ScenarioReader.readText(text(robots, colours), Path.of("crowd-" + robots + "-" + colours + ".world"));
    }

    /**
     * The panel colours of a hall, {@code 0x00RRGGBB}: blue, red, green, and then colours as different as possible from
     * all others, walls and robots included.
     */
    public static List<Integer> colours(int count) {
        return names(count).stream().map(NamedColours.byName()::get).toList();
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

    /** The colours that the cameras report; a camera with such a list casts fewer rays. */
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

    /** Adds the inner walls, which are between the rows of start poses, and the panels. */
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

    /** Adds the panels: the first colour at the upper wall, the next at the right wall, and so on clockwise. */
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

    /**
     * Chooses named colours for the panels of a crowd's halls. Each is as far as possible from all earlier ones and
     * from those of walls and robots.
     */
    private static final class CrowdColours {
        private static final List<String> TAKEN = List.of("black", "orange", "white");
        private static final List<String> FIRST = List.of("blue", "red", "green");

        private CrowdColours() {}

        /** The given number of names, starting with the three colours of the paper. */
        static List<String> names(int count) {
            Map<String, Integer> candidates = new TreeMap<>(NamedColours.byName());
            var chosen = new ArrayList<String>(FIRST.subList(0, Math.min(count, FIRST.size())));
            var values = new ArrayList<Integer>();
            TAKEN.forEach(name -> values.add(candidates.get(name)));
            FIRST.forEach(name -> values.add(candidates.get(name)));
            while (chosen.size() < count) {
                String farthest = farthest(candidates, values);
                chosen.add(farthest);
                values.add(candidates.get(farthest));
            }
            return chosen;
        }

        private static String farthest(Map<String, Integer> candidates, Collection<Integer> from) {
            String best = "";
            int bestSquare = -1;
            for (var candidate : candidates.entrySet()) {
                int square = from.stream()
                        .mapToInt(other -> square(candidate.getValue(), other))
                        .min()
                        .orElse(Integer.MAX_VALUE);
                if (square > bestSquare) {
                    best = candidate.getKey();
                    bestSquare = square;
                }
            }
            return best;
        }

        private static int square(int colour, int other) {
            int sum = 0;
            for (int shift = 0; shift <= 16; shift += 8) {
                int difference = (colour >> shift & 0xff) - (other >> shift & 0xff);
                sum += difference * difference;
            }
            return sum;
        }
    }
}
