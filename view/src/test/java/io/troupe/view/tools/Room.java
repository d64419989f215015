package io.troupe.view.tools;

import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** A room of 10 m by 10 m around the origin, in which all readings are known; and runs in it. */
final class Room {
    /** A robot at (1, 2) that looks to the north, with a sonar ahead and one to the left, a laser and a camera. */
    static final WorldSpec WORLD =
            ScenarioReader.readText("""
            name "room"
            interval_sim 100
            define wall model ( color "black" )
            wall ( name "north" pose [ 0 5.1 0 0 ] size [ 10.4 0.2 0.5 ] )
            wall ( name "south" pose [ 0 -5.1 0 0 ] size [ 10.4 0.2 0.5 ] )
            wall ( name "east" pose [ 5.1 0 0 0 ] size [ 0.2 10 0.5 ] )
            wall ( name "west" pose [ -5.1 0 0 0 ] size [ 0.2 10 0.5 ] )
            model ( name "red box" color "red" pose [ 1 4.95 0 0 ] size [ 1 0.1 0.5 ] )
            position
            (
              name "robot 1"
              color "blue"
              pose [ 1 2 0 90 ]
              size [ 0.4 0.4 0.2 ]
              drive "diff"
              localization "gps"
              ranger
              (
                scount 2
                spose[0] [ 0.1 0 0 ] spose[1] [ 0 0.1 90 ]
                sview [ 0 20 15 ]
              )
              laser ( range_max 20 fov 180 samples 3 )
              blobfinder ( image [ 80 60 ] range 4 fov 60 colors_count 1 colors [ "red" ] )
            )
            """, Path.of("room.world")).world();

    private Room() {}

    /** The lines of a run, as RunRecorder writes them. */
    static String log(WorldSpec world, List<Snapshot> snapshots) {
        return header(world)
                + snapshots.stream().map(Room::poses).collect(Collectors.joining())
                + "{\"t\":1000.0,\"type\":\"summary\",\"switches\":0}\n";
    }

    /** Writes the log of a run without services, by RunRecorder itself. */
    static Path recorded(Path file, WorldSpec world, List<Snapshot> snapshots) throws IOException {
        try (var log = new RunLog(file)) {
            log.begin(world, RecordedRun.Settings.defaults());
            var recorder = new RunRecorder(world, SubsumptionTable.ofThePaper(), log, change -> {});
            recorder.start(snapshots.getFirst());
            snapshots.stream().skip(1).forEach(recorder::record);
        }
        return file;
    }

    static String header(WorldSpec world) {
        return "{\"t\":0.0,\"type\":\"header\",\"format\":\"troupe-run\",\"version\":1,\"program\":\"Troupe\",\"world\":\""
                + world.name() + "\",\"robots\":" + world.robots().size() + ",\"seed\":7,\"interval\":0.1}\n";
    }

    static String poses(Snapshot snapshot) {
        return IntStream.range(0, snapshot.robots().size())
                .mapToObj(i -> pose(
                        snapshot.timeMicros() / 1e6, i + 1, snapshot.robots().get(i)))
                .collect(Collectors.joining());
    }

    private static String pose(double seconds, int robot, RobotReading reading) {
        return String.format(
                Locale.ROOT,
                "{\"t\":%s,\"type\":\"pose\",\"robot\":%d,\"x\":%s,\"y\":%s,\"heading\":%s,\"gap\":%s,\"service\":\"avoid\"}%n",
                seconds,
                robot,
                reading.pose().x(),
                reading.pose().y(),
                reading.pose().headingRad(),
                Double.isInfinite(reading.wallGapM()) ? "null" : reading.wallGapM());
    }
}
