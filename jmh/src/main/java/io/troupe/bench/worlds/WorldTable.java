package io.troupe.bench.worlds;

import io.troupe.bench.BuildTable;
import io.troupe.bench.TurnMeter;
import io.troupe.tools.UsedHeap;
import java.lang.ref.Reference;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Our simulator in the scenes of {@link BuildScene}. An operation is one interval of simulated time, and the answer is
 * a checksum over every bit of the readings after the turn.
 */
public final class WorldTable implements BuildTable {
    private static final Set<BuildScene> QUICK = Set.of(BuildScene.FULL, BuildScene.LASERS, BuildScene.CROWDED);
    private static final String ROBOTS = " robots";
    private static final int SETTLING_INTERVALS = 5;

    private final List<Integer> robots;
    private final int threads;
    private String built = "";
    private @Nullable TroupeWorld world;

    /**
     * A table of all scenes.
     *
     * @param robots the numbers of robots in each scene; empty for a hundred, and in one scene 2 and 1,000 as well
     * @param threads the sensing threads
     */
    public WorldTable(List<Integer> robots, int threads) {
        this.robots = List.copyOf(robots);
        this.threads = threads;
    }

    @Override
    public List<Row> rows() {
        return Stream.of(BuildScene.values())
                .flatMap(scene ->
                        robots.isEmpty() ? usual(scene) : robots.stream().map(count -> row(scene, count, Choice.QUICK)))
                .toList();
    }

    private static Stream<Row> usual(BuildScene scene) {
        var hundred = Stream.of(row(scene, 100, QUICK.contains(scene) ? Choice.QUICK : Choice.USUAL));
        return scene == BuildScene.FULL
                ? Stream.concat(hundred, Stream.of(row(scene, 2, Choice.USUAL), row(scene, 1_000, Choice.USUAL)))
                : hundred;
    }

    private static Row row(BuildScene scene, int count, Choice choice) {
        return new Row(String.format(Locale.ROOT, "%s, %,d%s", scene, count, ROBOTS), choice, "robot");
    }

    @Override
    public Turn turn(String row, int operations) {
        TroupeWorld running = world(row);
        Turn turn = TurnMeter.measure(operations, () -> running.advance(operations));
        return turn.withAnswer(running.checksum());
    }

    /** The world of this row; that of the row before is dropped. */
    private TroupeWorld world(String row) {
        if (world == null || !row.equals(built)) {
            world = null;
            world = created(row);
            built = row;
        }
        return world;
    }

    private TroupeWorld created(String row) {
        return new TroupeWorld(scene(row).spec(count(row)), true, threads);
    }

    @Override
    public double keptBytes(String row) {
        world = null;
        var spec = scene(row).spec(count(row));
        long empty = UsedHeap.bytes();
        var created = new TroupeWorld(spec, true, threads);
        created.advance(SETTLING_INTERVALS);
        long bytes = UsedHeap.bytes() - empty;
        Reference.reachabilityFence(spec);
        Reference.reachabilityFence(created);
        return (double) bytes / count(row);
    }

    private static BuildScene scene(String row) {
        String name = row.substring(0, row.indexOf(','));
        return BuildScene.valueOf(name.toUpperCase(Locale.ROOT).replace('-', '_'));
    }

    private static int count(String row) {
        String number = row.substring(row.indexOf(' ') + 1, row.length() - ROBOTS.length());
        return Integer.parseInt(number.replace(",", ""));
    }
}
