package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import java.io.IOException;
import java.lang.reflect.RecordComponent;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

/** What a snapshot has is in the run log, on the live page and in the exports, or there is a reason. */
class SnapshotReadersTest {
    private static final String COMPUTED = "computed from the poses when the log is read";
    private static final String IN_THE_MAP = "the run knows the displaced obstacles, from moved and placed";

    private static final Map<String, String> NOT_IN_THE_LOG = Map.of(
            "tick", "the time says it",
            "odometry", "not needed to repeat or show a run",
            "sonarM", COMPUTED,
            "blobs", COMPUTED,
            "rangersM", COMPUTED,
            "intensities", COMPUTED,
            "boxes", "an intervention puts them",
            "away", "docs/run-log.md says so: only a program takes robots out, which the log does not have",
            "placed", IN_THE_MAP);

    private static final Map<String, String> NOT_ON_THE_PAGE =
            Map.of("tick", "frames have numbers of their own", "placed", IN_THE_MAP);

    private static final Map<String, String> NOT_EXPORTED = Map.of(
            "tick", "the time says it",
            "contacts", "events of the run",
            "moved", IN_THE_MAP,
            "placed", IN_THE_MAP,
            "held", "the readings of grippers say that they hold something");

    @Test
    void everyComponent_isInTheRunLog() throws Exception {
        assertReads(NOT_IN_THE_LOG, "io.troupe.view.RunRecorder");
    }

    @Test
    void everyComponent_isOnThePage() throws Exception {
        assertReads(NOT_ON_THE_PAGE, "io.troupe.view.live.ViewMessages", "io.troupe.view.live.ViewedRun");
    }

    @Test
    void everyComponent_isExported() throws Exception {
        assertReads(NOT_EXPORTED, "io.troupe.view.tools.FoxgloveChannels");
    }

    private static void assertReads(Map<String, String> reasons, String... classes) throws Exception {
        var names = new StringBuilder();
        for (String name : classes) {
            Class<?> type = Class.forName(name);
            for (Class<?> each : withNested(type)) {
                names.append(bytes(each));
            }
        }
        var forgotten = new TreeSet<String>();
        Stream.of(Snapshot.class, RobotReading.class)
                .flatMap(type -> Stream.of(type.getRecordComponents()))
                .map(RecordComponent::getName)
                .filter(component -> !mentions(names, component))
                .forEach(forgotten::add);
        assertThat(forgotten)
                .as("components that %s does not read", List.of(classes))
                .isEqualTo(new TreeSet<>(reasons.keySet()));
    }

    /** True if the pool of constants has this name: of a method that is called, for example. */
    private static boolean mentions(StringBuilder classes, String name) {
        return classes.indexOf("\1\0" + (char) name.length() + name) >= 0;
    }

    private static List<Class<?>> withNested(Class<?> type) {
        var all = new ArrayList<Class<?>>(List.of(type));
        for (Class<?> nested : type.getDeclaredClasses()) {
            all.addAll(withNested(nested));
        }
        return all;
    }

    private static String bytes(Class<?> type) throws IOException {
        String file = type.getName().substring(type.getPackageName().length() + 1) + ".class";
        try (var stream = type.getResourceAsStream(file)) {
            assertThat(stream).as(file).isNotNull();
            return new String(stream.readAllBytes(), StandardCharsets.ISO_8859_1);
        }
    }
}
