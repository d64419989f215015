package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * Reads randomly damaged copies of all shipped worlds, random words and damaged images: the result is a scenario or a
 * {@link WorldFileException}.
 */
class ReaderFuzzTest {
    private static final long SEED = 20_260_303;
    private static final Path SHIPPED = Path.of("..", "demo", "worlds");

    private static final String[] WORDS = {
        "(",
        ")",
        "[",
        "]",
        "(",
        ")",
        "model",
        "position",
        "ranger",
        "laser",
        "blobfinder",
        "sensor",
        "block",
        "window",
        "gripper",
        "define",
        "include",
        "pose",
        "size",
        "origin",
        "bitmap",
        "boundary",
        "color",
        "color_rgba",
        "points",
        "point[0]",
        "point[1]",
        "point[2]",
        "spose[0]",
        "scount",
        "sview",
        "samples",
        "range",
        "range_max",
        "fov",
        "polygons",
        "polygon[0].points",
        "polygon[0].point[0]",
        "blocks",
        "ssize[0]",
        "ctrl",
        "wifi",
        "noise",
        "velocity",
        "velocity_bounds",
        "localization",
        "odom_error",
        "drive",
        "mass",
        "obstacle_return",
        "ranger_return",
        "laser_return",
        "interval_sim",
        "unit_length",
        "name",
        "image",
        "colors",
        "\"cave.png\"",
        "\"pioneer.inc\"",
        "\"t.world\"",
        "\"odom\"",
        "\"cm\"",
        "\"red\"",
        "\"\"",
        "0",
        "1",
        "-1",
        "2",
        "0.5",
        "1e308",
        "-1e-308",
        "1e9",
        "999999999999",
        "[ 1 1 ]",
        "[ 0 0 0 ]",
        "[ 1 1 1 1 ]",
        "[ 0 5 15 ]",
        "[ -1 1 -1 1 -1 1 -90 90 ]",
        "pioneer2dx",
        "wall",
        "unknown",
        "#",
        "\n"
    };

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() throws IOException {
        worlds = new Worlds(dir);
        try (Stream<Path> shipped = Files.list(SHIPPED)) {
            for (Path file : shipped.sorted().toList()) {
                Files.copy(file, dir.resolve(file.getFileName().toString()));
            }
        }
    }

    /** True if the file could still be read by the strict reader. */
    private boolean survives(Path file, String what) {
        boolean lenient = reads(file, true, what);
        boolean strict = reads(file, false, what);
        assertThat(strict && !lenient)
                .as("read strictly but not leniently: " + what)
                .isFalse();
        return strict;
    }

    private boolean reads(Path file, boolean lenient, String what) {
        try {
            if (lenient) {
                ScenarioReader.readLeniently(
                        file, warning -> assertThat(warning.toString()).as(what).matches("(?s)\\S+:\\d+:\\d+: .+"));
            } else {
                ScenarioReader.read(file, warning -> {});
            }
            return true;
        } catch (WorldFileException expected) {
            assertThat(expected).as(what).hasMessageMatching("(?s)\\S+:\\d+:\\d+: .+");
            return false;
        } catch (RuntimeException | StackOverflowError | OutOfMemoryError e) {
            throw new AssertionError(what + ", " + file.getFileName() + ":\n" + text(file), e);
        }
    }

    private static String text(Path file) {
        try {
            return Files.readString(file);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private List<Path> shippedTexts() throws IOException {
        try (Stream<Path> files = Files.list(dir)) {
            return files.filter(file -> file.toString().matches(".*\\.(world|cfg|inc)"))
                    .sorted()
                    .toList();
        }
    }

    @Test
    void shippedWorlds_changedAtRandom_areReadOrRefused() throws IOException {
        List<Path> files = new ArrayList<>(shippedTexts());
        files.add(worlds.write("crowd.world", CrowdWorld.text(3)));
        files.add(worlds.write("newer.world", """
                define pioneer position ( size [ 0.4 0.4 0.2 ] velocity_bounds [ -0.5 0.5 0 0 0 0 -90 90 ]
                  ranger ( sensor ( pose [ 0.1 0 0 0 ] range [ 0 5 ] fov 15 samples 1 noise [ 0 0.01 0 ] ) sensor () ) )
                pioneer ( name "a" localization "odom" odom_error [ 0.1 0.1 0 0.1 ] model ( size [ 0.1 0.1 ] ) )
                """));
        var random = new Random(SEED);
        int survivors = 0;
        int rounds = 0;
        for (Path file : files) {
            String whole = text(file);
            for (int round = 0; round < 60; round++) {
                String damaged = damaged(whole, random);
                Files.writeString(file, damaged);
                // an include file is read through the world that uses it
                Path asked = file.toString().endsWith(".inc") ? worlds.file("office.world") : file;
                survivors += survives(asked, "seed " + SEED + ", round " + round + " of " + file.getFileName()) ? 1 : 0;
                rounds++;
            }
            Files.writeString(file, whole);
        }

        assertThat(survivors).as("files that could still be read").isBetween(rounds / 50, rounds * 49 / 50);
    }

    private static String damaged(String whole, Random random) {
        var text = new StringBuilder(whole);
        for (int changes = 1 + random.nextInt(2); changes > 0; changes--) {
            int from = random.nextInt(text.length() + 1);
            int to = Math.min(text.length(), from + random.nextInt(15));
            switch (random.nextInt(4)) {
                case 0 -> text.delete(from, to);
                case 1 -> text.insert(from, text.substring(from, to));
                case 2 -> text.insert(from, " " + WORDS[random.nextInt(WORDS.length)] + " ");
                default -> text.replace(from, to, " " + WORDS[random.nextInt(WORDS.length)] + " ");
            }
        }
        return text.toString();
    }

    @Test
    void words_inAnyOrder_areReadOrRefused() {
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < 1000; round++) {
            var text = new StringBuilder();
            for (int words = random.nextInt(40); words >= 0; words--) {
                text.append(WORDS[random.nextInt(WORDS.length)]).append(' ');
            }
            survivors +=
                    survives(worlds.write("t.world", text.toString()), "seed " + SEED + ", round " + round) ? 1 : 0;
        }

        assertThat(survivors).as("files that could be read").isBetween(1, 500);
    }

    @Test
    void properties_inEntities_areReadOrRefused() {
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < 1000; round++) {
            var text = new StringBuilder();
            entity(text, random, 0);
            survivors +=
                    survives(worlds.write("t.world", text.toString()), "seed " + SEED + ", round " + round) ? 1 : 0;
        }

        assertThat(survivors).as("files that could be read").isBetween(10, 990);
    }

    /** An entity with properties, most of the right kind. */
    private static void entity(StringBuilder text, Random random, int depth) {
        String[] types = {"model", "position", "ranger", "laser", "blobfinder", "sensor", "gripper"};
        text.append(types[depth == 0 ? random.nextInt(2) : random.nextInt(types.length)])
                .append(" ( ");
        String[] properties = {
            "pose [ 1 1 0 0 ]",
            "size [ 1 1 ]",
            "size [ 1e308 1 ]",
            "origin [ 1 0 0 90 ]",
            "boundary 1",
            "bitmap \"cave.png\"",
            "color \"blue\"",
            "mass 1e-300",
            "obstacle_return 0",
            "ranger_return 0.5",
            "range_max 4",
            "range [ 0 4 ]",
            "samples 20",
            "fov 30",
            "noise [ 0 0 1 ]",
            "scount 1 spose[0] [ 0 0 0 ]",
            "velocity [ 1 0 0 1 ]",
            "velocity_bounds [ -1 1 0 0 0 0 -9 9 ]",
            "localization \"odom\"",
            "size [ 16 16 ]",
            "pose [ 1e6 0 0 0 ]"
        };
        for (int i = random.nextInt(4); i > 0; i--) {
            text.append(properties[random.nextInt(properties.length)]).append(' ');
        }
        for (int i = depth < 4 ? random.nextInt(3) : 0; i > 0; i--) {
            entity(text, random, depth + 1);
        }
        text.append(") ");
    }

    @Test
    void image_changedAtRandom_isReadOrRefused() throws IOException {
        byte[] whole = Files.readAllBytes(worlds.file("cave.png"));
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < 100; round++) {
            byte[] damaged = whole.clone();
            for (int changes = 1 + random.nextInt(3); changes > 0; changes--) {
                // half of the changes hit the header
                damaged[random.nextInt(random.nextBoolean() ? 60 : damaged.length)] = (byte) random.nextInt(256);
            }
            Files.write(worlds.file("cave.png"), damaged);
            survivors += survives(worlds.file("cave.world"), "seed " + SEED + ", round " + round) ? 1 : 0;
        }

        assertThat(survivors).as("images that could be read").isBetween(1, 99);
    }
}
