package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import java.util.Random;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Reading a damaged file gives a world or a {@link WorldFileException}, never another exception. */
class DamagedFilesTest {
    private static final long SEED = 20_260_102;
    private static final String[] PIECES = {
        "(",
        ")",
        "[",
        "]",
        "\"",
        "#",
        "\n",
        " ",
        "-",
        "1e308",
        "-1e308",
        "1e-320",
        "0",
        "-1",
        "99999999999",
        "0.5",
        "define",
        "include",
        "include \"pioneer.inc\"",
        "model (",
        "position (",
        "block (",
        "points 3",
        "point[0] [ 1 1 ]",
        "size",
        "pose",
        "[ 0 0 0 0 ]",
        "[ 1e300 1e300 ]",
        "boundary 1",
        "origin [ 1e300 0 0 0 ]",
        "color \"grey\"",
        "\u0000",
        "\u20ac",
        "include \"\"",
        "include \"\u0001/x\"",
        "unit_length \"mm\"",
        "unit_angle \"radians\"",
        "provides",
        "\"::::\"",
        ":"
    };

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
        worlds.write("pioneer.inc", Worlds.PIONEER);
        worlds.write("arena.world", Worlds.ARENA);
    }

    /** True if the file could still be read. */
    private boolean survives(String name, String text, String what) {
        Path file = worlds.write(name, text);
        try {
            ScenarioReader.read(file);
            return true;
        } catch (WorldFileException expected) {
            assertThat(expected).as(what).hasMessageMatching("(?s)\\S+:\\d+:\\d+: .+");
            return false;
        } catch (RuntimeException | StackOverflowError e) {
            throw new AssertionError(what + " of:\n" + text, e);
        }
    }

    @Test
    void world_cutOffAnywhere_isReadOrRefused() {
        String whole = Worlds.PIONEER + Worlds.ARENA.replace("include \"pioneer.inc\"", "");
        assertThat(survives("t.world", whole, "the whole")).isTrue();
        for (int end = 0; end < whole.length(); end++) {
            survives("t.world", whole.substring(0, end), "the first " + end + " characters");
        }
    }

    @Test
    void configuration_cutOffAnywhere_isReadOrRefused() {
        for (int end = 0; end < Worlds.CONFIG.length(); end++) {
            survives("t.cfg", Worlds.CONFIG.substring(0, end), "the first " + end + " characters");
        }
    }

    @Test
    void world_changedAtRandom_isReadOrRefused() {
        String whole = Worlds.PIONEER + Worlds.ARENA.replace("include \"pioneer.inc\"", "");
        int survivors = mutate("t.world", whole, 3000);

        assertThat(survivors).as("files that could still be read").isBetween(30, 2970);
    }

    @Test
    void configuration_changedAtRandom_isReadOrRefused() {
        int survivors = mutate("t.cfg", Worlds.CONFIG, 1000);

        assertThat(survivors).as("files that could still be read").isBetween(10, 990);
    }

    private int mutate(String name, String whole, int rounds) {
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < rounds; round++) {
            var text = new StringBuilder(whole);
            int changes = 1 + random.nextInt(3);
            for (int i = 0; i < changes; i++) {
                change(text, random);
            }
            survivors += survives(name, text.toString(), "seed " + SEED + ", round " + round) ? 1 : 0;
        }
        return survivors;
    }

    private static void change(StringBuilder text, Random random) {
        int from = random.nextInt(text.length());
        int to = Math.min(text.length(), from + random.nextInt(12));
        String piece = PIECES[random.nextInt(PIECES.length)];
        switch (random.nextInt(5)) {
            case 0 -> text.delete(from, to);
            case 1 -> text.insert(from, ' ' + piece + ' ');
            case 2 -> text.replace(from, to, piece);
            case 3 -> text.insert(random.nextInt(text.length()), text.substring(from, to));
            default -> number(text, from, piece);
        }
    }

    /** Replaces the next number, so that more files get past the grammar. */
    private static void number(StringBuilder text, int from, String piece) {
        int start = from;
        while (start < text.length() && !Character.isDigit(text.charAt(start))) {
            start++;
        }
        int end = start;
        while (end < text.length() && (Character.isDigit(text.charAt(end)) || text.charAt(end) == '.')) {
            end++;
        }
        text.replace(start, end, piece);
    }
}
