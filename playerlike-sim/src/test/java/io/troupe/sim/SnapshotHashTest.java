package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import java.lang.reflect.Constructor;
import java.lang.reflect.RecordComponent;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.SortedMap;
import java.util.TreeMap;
import org.junit.jupiter.api.Test;

/** The checksum covers every component of a snapshot, those that will be added, too. */
class SnapshotHashTest {
    /** A snapshot in which nothing is empty. */
    private static Snapshot full() {
        var image = new BlobImage(80, 60, List.of(new ColourBlob(0xff0000, 12, 1, 2, 3, 4, 5, 6, 1.5)));
        List<DeviceReading> devices = List.of(
                new DeviceReading.Fiducials(List.of(new DeviceReading.Fiducial(3, 1, 2, 0.5))),
                new DeviceReading.Picture(60, List.of(new DeviceReading.Column(0xff, 1, 2))),
                new DeviceReading.Grip(DeviceReading.Paddles.OPEN, true, false, true),
                new DeviceReading.Pressed(List.of(true, false)));
        var robot = new RobotReading(
                new Pose(1, 2, 3),
                new Odometry(new Pose(4, 5, 6), 0.1, 0.2, 0.3, true),
                List.of(1.0, 2.0),
                image,
                List.of(List.of(3.0, 4.0), List.of(5.0)),
                List.of(List.of(1.0, 0.0), List.of(1.0)),
                devices,
                0.7);
        SortedMap<Integer, Optional<Pose>> placed = new TreeMap<>();
        placed.put(1, Optional.of(new Pose(7, 8, 9)));
        placed.put(2, Optional.empty());
        return new Snapshot(
                5,
                500_000,
                List.of(robot, robot),
                List.of(new Contact(400_000, 0, "wall", -1)),
                List.of(new Pose(1, 1, 1), new Pose(2, 2, 2)),
                List.of(new ColouredBox(1, 0xff, 3, 4)),
                placed,
                List.of(1),
                new TreeMap<>(Map.of(0, 0)));
    }

    @Test
    void anyChange_changesTheChecksum() throws Exception {
        Snapshot whole = full();
        long hash = SnapshotHash.of(whole);
        Map<String, Object> changes = changes("snapshot", whole);
        assertThat(changes).hasSizeGreaterThan(80);
        changes.forEach((what, changed) -> assertThat(SnapshotHash.of((Snapshot) changed))
                .as(what + " changed: " + changed)
                .isNotEqualTo(hash));
        assertThat(changes.values().stream()
                        .map(changed -> SnapshotHash.of((Snapshot) changed))
                        .distinct())
                .as("checksums of different snapshots")
                .hasSameSizeAs(new HashSet<>(changes.values()));
    }

    @Test
    void whoHoldsAThing_andListsOfTheSameNumbers_countApart() {
        var pose = new Pose(2, 0, 0);
        SortedMap<Integer, Integer> first = new TreeMap<>(Map.of(0, 0));
        SortedMap<Integer, Integer> second = new TreeMap<>(Map.of(0, 1));
        assertThat(SnapshotHash.of(new Snapshot(5, 500_000, List.of(), List.of(), List.of(pose), first)))
                .isNotEqualTo(SnapshotHash.of(new Snapshot(5, 500_000, List.of(), List.of(), List.of(pose), second)));
        SortedMap<Integer, Optional<Pose>> none = new TreeMap<>();
        SortedMap<Integer, Optional<Pose>> gone = new TreeMap<>(Map.of(1, Optional.empty()));
        var away = new Snapshot(5, 0, List.of(), List.of(), List.of(), List.of(), none, List.of(1, 0), new TreeMap<>());
        var placed = new Snapshot(5, 0, List.of(), List.of(), List.of(), List.of(), gone, List.of(), new TreeMap<>());
        assertThat(SnapshotHash.of(away)).isNotEqualTo(SnapshotHash.of(placed));
    }

    /** Copies of a value in which one number, text, or the length of one list differs, by what that is. */
    private static Map<String, Object> changes(String path, Object value) throws Exception {
        var changes = new LinkedHashMap<String, Object>();
        switch (value) {
            case Record whole -> {
                RecordComponent[] components = whole.getClass().getRecordComponents();
                var types = new Class<?>[components.length];
                var values = new Object[components.length];
                for (int i = 0; i < components.length; i++) {
                    types[i] = components[i].getType();
                    components[i].getAccessor().setAccessible(true);
                    values[i] = components[i].getAccessor().invoke(whole);
                    assertThat(values[i])
                            .as(path + "." + components[i].getName() + " in this test")
                            .isNotNull();
                }
                Constructor<?> create = whole.getClass().getDeclaredConstructor(types);
                create.setAccessible(true);
                for (int i = 0; i < components.length; i++) {
                    for (var each : changes(path + "." + components[i].getName(), values[i])
                            .entrySet()) {
                        Object[] others = values.clone();
                        others[i] = each.getValue();
                        changes.put(each.getKey(), create.newInstance(others));
                    }
                }
            }
            case List<?> list -> {
                assertThat(list).as(path + " in this test").isNotEmpty();
                changes.put(path + " without the last", new ArrayList<>(list.subList(0, list.size() - 1)));
                for (int i = 0; i < list.size(); i++) {
                    for (var each : changes(path + "[" + i + "]", list.get(i)).entrySet()) {
                        var others = new ArrayList<Object>(list);
                        others.set(i, each.getValue());
                        changes.put(each.getKey(), others);
                    }
                }
            }
            case SortedMap<?, ?> map -> {
                assertThat(map).as(path + " in this test").isNotEmpty();
                changes.put(path + " with other keys", shifted(map));
                var rest = new TreeMap<Object, Object>(map);
                rest.remove(map.firstKey());
                changes.put(path + " without the first", rest);
                for (var entry : map.entrySet()) {
                    for (var each : changes(path + "[" + entry.getKey() + "]", entry.getValue())
                            .entrySet()) {
                        var others = new TreeMap<Object, Object>(map);
                        others.put(entry.getKey(), each.getValue());
                        changes.put(each.getKey(), others);
                    }
                }
            }
            case Optional<?> optional -> {
                if (optional.isPresent()) {
                    changes.put(path + " empty", Optional.empty());
                    for (var each : changes(path, optional.get()).entrySet()) {
                        changes.put(each.getKey(), Optional.of(each.getValue()));
                    }
                } else {
                    changes.put(path + " there", Optional.of(new Pose(0, 0, 0)));
                }
            }
            case Double number -> changes.put(path, Math.nextUp(number));
            case Integer number -> changes.put(path, number + 1);
            case Long number -> changes.put(path, number + 1);
            case Boolean truth -> changes.put(path, !truth);
            case String text -> changes.put(path, text + "x");
            case Enum<?> one ->
                changes.put(
                        path,
                        one.getDeclaringClass()
                                .getEnumConstants()[
                                (one.ordinal() + 1) % one.getDeclaringClass().getEnumConstants().length]);
            default -> throw new AssertionError(path + " is a " + value.getClass() + ": teach this test to change it");
        }
        return changes;
    }

    private static SortedMap<Object, Object> shifted(SortedMap<?, ?> map) {
        var shifted = new TreeMap<Object, Object>();
        map.forEach((key, value) -> shifted.put((Integer) key + 10, value));
        return shifted;
    }
}
