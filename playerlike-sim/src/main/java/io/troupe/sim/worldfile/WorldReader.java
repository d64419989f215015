package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** Converts the tree of a {@code .world} file to a {@link WorldSpec}. */
final class WorldReader {
    private static final int LONGEST_INTERVAL_MILLIS = 60_000;
    /** Limit of what a lenient reader leaves out: it reads the world anew each time. */
    private static final int MOST_LEFT_OUT = 200;

    private final Units units;
    private final Dialect dialect;
    private final Diagnostics diagnostics;
    private final ShapeReader shapes;
    private final RobotReader robotReader;
    private final List<RobotSpec> robots = new ArrayList<>();
    private final List<ObstacleSpec> obstacles = new ArrayList<>();
    private final Map<String, Integer> unnamed = new TreeMap<>();

    private WorldReader(
            Units units, Dialect dialect, Diagnostics diagnostics, ShapeReader shapes, boolean intensities) {
        this.units = units;
        this.dialect = dialect;
        this.diagnostics = diagnostics;
        this.shapes = shapes;
        this.robotReader = new RobotReader(units, dialect, shapes, diagnostics, intensities);
    }

    /**
     * Reads and checks the world of a parsed file. A lenient reader leaves out each property or else entity that cannot
     * be used, and reads the rest again.
     */
    static WorldSpec read(Document document, Diagnostics diagnostics) {
        Document rest = VocabularyCheck.check(document, diagnostics);
        var bitmaps = new BitmapShapes.Cache();
        for (int leftOut = 0; ; leftOut++) {
            try {
                return world(rest, diagnostics, bitmaps);
            } catch (WorldFileException e) {
                SourcePosition where = e.where().orElse(null);
                Document.Without without = where == null || !diagnostics.isLenient() ? null : rest.without(where);
                if (where == null || without == null) {
                    throw e;
                }
                if (leftOut == MOST_LEFT_OUT) {
                    throw new WorldFileException(
                            where,
                            e.problem() + "; more than " + MOST_LEFT_OUT + " things of this world cannot be used");
                }
                diagnostics.warn(where, e.problem() + "; " + without.leftOut() + " is left out");
                rest = without.document();
            }
        }
    }

    private static WorldSpec world(Document document, Diagnostics diagnostics, BitmapShapes.Cache bitmaps) {
        Entity root = document.root();
        Dialect dialect = Dialect.of(root, diagnostics);
        var shapes = new ShapeReader(
                Units.of(root), new BitmapShapes(root.where().file(), bitmaps, diagnostics), diagnostics);
        var reader = new WorldReader(Units.of(root), dialect, diagnostics, shapes, dialect.hasBright(root));
        for (Entity entity : document.entities()) {
            switch (entity.type()) {
                case "position" -> reader.robot(entity);
                case "model" -> reader.obstacle(entity, Pose.ORIGIN);
                default -> {} // a window of Stage's graphical interface, or something left out
            }
        }
        Path file = root.where().file();
        String name = root.text("name", String.valueOf(file.getFileName()));
        var world = new WorldSpec(name, file, intervalMillis(root), reader.robots, reader.obstacles);
        WorldChecks.check(world, diagnostics);
        return world;
    }

    private static int intervalMillis(Entity root) {
        int interval = root.whole("interval_sim", 100);
        if (interval < 1 || interval > LONGEST_INTERVAL_MILLIS) {
            throw new WorldFileException(
                    root.whereOf("interval_sim"),
                    "\"interval_sim\" must be from 1 to " + LONGEST_INTERVAL_MILLIS + " milliseconds, not " + interval);
        }
        return interval;
    }

    private void robot(Entity position) {
        checkLaserReturn(position);
        reportProgram(position);
        robots.add(robotReader.read(position, name(position)));
    }

    private void obstacle(Entity model, Pose outer) {
        checkLaserReturn(model);
        reportProgram(model);
        Pose pose = outer.compose(units.pose(model, "pose"));
        obstacles.add(new ObstacleSpec(
                name(model),
                pose,
                shapes.shape(model),
                model.colour(),
                model.flag("obstacle_return", true),
                dialect.blocksRangers(model),
                model.flag("blob_return", true),
                DeviceReader.traits(model, dialect),
                model.where()));
        for (Entity child : model.children()) {
            if (child.type().equals("model")) {
                if (model.flag("movable", false)) {
                    diagnostics.warn(
                            child.where(), "a model on one that is \"movable\" stays where it is when that is pushed");
                }
                obstacle(child, pose);
            } else if (child.type().equals("position")) {
                diagnostics.warn(
                        child.where(), "a position on a model does not drive here: it is read as a part of the model");
                obstacle(child, pose);
            } else if (Vocabulary.isSensor(child.type())) {
                diagnostics.warn(
                        child.where(),
                        "a " + child.type()
                                + " must hang on a robot (a position); on a model that stands still it is left"
                                + " out");
            }
        }
    }

    private void reportProgram(Entity model) {
        String program = model.text("ctrl", "");
        if (!program.isBlank()) {
            diagnostics.warn(
                    model.whereOf("ctrl"),
                    "\"ctrl\" \"" + program
                            + "\" is a program that Stage runs and that is not run here: robots wait for"
                            + " their clients");
        }
    }

    private void checkLaserReturn(Entity model) {
        boolean differs =
                model.has("laser_return") && model.number("laser_return", 1) > 0 != dialect.blocksRangers(model);
        if (differs) {
            diagnostics.warn(
                    model.whereOf("laser_return"),
                    "lasers and sonars see the same things here: \"ranger_return\" counts, and \"laser_return\" differs"
                            + " from it");
        }
    }

    /** The given name, or the type with its number within the type, as in Stage. */
    private String name(Entity entity) {
        int number = unnamed.merge(entity.type(), 1, Integer::sum) - 1;
        return entity.text("name", entity.type() + ":" + number);
    }
}
