package io.troupe.sim.scenario;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** Turns the tree of a {@code .world} file into a {@link WorldSpec}. */
final class WorldReader {
    private static final int LONGEST_INTERVAL_MILLIS = 60_000;

    private final Units units;
    private final RobotReader robotReader;
    private final List<RobotSpec> robots = new ArrayList<>();
    private final List<ObstacleSpec> obstacles = new ArrayList<>();
    private final Map<String, Integer> unnamed = new TreeMap<>();

    private WorldReader(Units units) {
        this.units = units;
        this.robotReader = new RobotReader(units);
    }

    /**
     * The world of a file, checked.
     *
     * @param asker where the file is named; null if the user named it
     */
    static WorldSpec read(Path file, @Nullable SourcePosition asker) {
        Document document = EntityParser.parse(Vocabulary.WORLD, file, asker);
        VocabularyCheck.check(document);
        Entity root = document.root();
        var reader = new WorldReader(Units.of(root));
        for (Entity entity : document.entities()) {
            switch (entity.type()) {
                case "position" -> reader.robots.add(reader.robotReader.read(entity, reader.name(entity)));
                case "model" -> reader.obstacle(entity, Pose.ORIGIN);
                default -> {} // a window of the graphical program
            }
        }
        String name = root.text("name", String.valueOf(file.getFileName()));
        var world = new WorldSpec(name, file, intervalMillis(root), reader.robots, reader.obstacles);
        WorldChecks.check(world);
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

    private void obstacle(Entity model, Pose outer) {
        refuseBitmap(model);
        Pose pose = outer.compose(units.pose(model, "pose"));
        Pose origin = units.pose(model, "origin");
        obstacles.add(new ObstacleSpec(
                name(model),
                pose,
                ShapeReader.shape(model, ShapeReader.size(model, units), origin),
                Colours.of(model),
                model.flag("obstacle_return", true),
                model.number("ranger_return", 1) > 0,
                model.flag("blob_return", true),
                model.where()));
        for (Entity child : model.children()) {
            if (child.type().equals("model")) {
                obstacle(child, pose);
            }
        }
    }

    /** The given name, or type and number within the type, as Stage does. */
    private String name(Entity entity) {
        int number = unnamed.merge(entity.type(), 1, Integer::sum) - 1;
        return entity.text("name", entity.type() + ":" + number);
    }

    static void refuseBitmap(Entity entity) {
        if (!entity.text("bitmap", "").isEmpty()) {
            throw new WorldFileException(
                    entity.whereOf("bitmap"), "a \"bitmap\" is not supported yet; describe the shape with blocks");
        }
    }
}
