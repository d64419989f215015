package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.tools.Thorough;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import java.util.function.Function;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Reads cut and randomly damaged copies of configurations and of all shipped worlds, random words and damaged images:
 * the result is a scenario or a {@link WorldFileException}, never another exception.
 */
class ReaderFuzzTest extends WorldFiles {
    private static final int WORLDS = Thorough.times(300, 3_000);
    private static final int FILES = Thorough.times(100, 1_000);
    private static final int IMAGES = Thorough.times(20, 100);
    private static final long SEED = 20_260_303;
    private static final long SEED_OF_PIECES = 20_260_102;
    private static final Path SHIPPED = Path.of("..", "demo", "worlds");
    private static final String WHOLE = PIONEER + ARENA.replace("include \"pioneer.inc\"", "");

    private static final String[] WORDS = """
            (;);[;];(;);model;position;ranger;laser;blobfinder;sensor;block;window;gripper;define;include;pose;size;\
            origin;bitmap;boundary;color;color_rgba;points;point[0];point[1];point[2];spose[0];scount;sview;samples;\
            range;range_max;fov;polygons;polygon[0].points;polygon[0].point[0];blocks;ssize[0];ctrl;wifi;noise;\
            velocity;velocity_bounds;localization;odom_error;drive;mass;obstacle_return;ranger_return;laser_return;\
            interval_sim;unit_length;name;image;colors;"cave.png";"pioneer.inc";"t.world";"odom";"cm";"red";"";0;1;\
            -1;2;0.5;1e308;-1e-308;1e9;999999999999;[ 1 1 ];[ 0 0 0 ];[ 1 1 1 1 ];[ 0 5 15 ];\
            [ -1 1 -1 1 -1 1 -90 90 ];pioneer2dx;wall;unknown;#;\n;\
            """.split(";");

    /** Pieces that replace parts of a text. */
    private static final String[] PIECES = """
            (;);[;];";#;\n;\s;-;1e308;-1e308;1e-320;0;-1;99999999999;0.5;define;include;include "pioneer.inc";\
            model (;position (;block (;points 3;point[0] [ 1 1 ];size;pose;[ 0 0 0 0 ];[ 1e300 1e300 ];boundary 1;\
            origin [ 1e300 0 0 0 ];color "grey";\0;\u20ac;include "";include "\u0001/x";unit_length "mm";\
            unit_angle "radians";provides;"::::";:;\
            """.split(";");

    private static final String[] PROPERTIES = """
            pose [ 1 1 0 0 ];size [ 1 1 ];size [ 1e308 1 ];origin [ 1 0 0 90 ];boundary 1;bitmap "cave.png";\
            color "blue";mass 1e-300;obstacle_return 0;ranger_return 0.5;range_max 4;range [ 0 4 ];samples 20;\
            fov 30;noise [ 0 0 1 ];scount 1 spose[0] [ 0 0 0 ];velocity [ 1 0 0 1 ];\
            velocity_bounds [ -1 1 0 0 0 0 -9 9 ];localization "odom";size [ 16 16 ];pose [ 1e6 0 0 0 ];\
            """.split(";");

    /** The included files beside the worlds, too, so that they can be damaged. */
    @BeforeEach
    void files() throws Exception {
        for (Path folder : List.of(
                SHIPPED, Path.of(SourceText.class.getResource("includes").toURI()))) {
            try (Stream<Path> shipped = Files.list(folder)) {
                for (Path file : shipped.sorted().toList()) {
                    Files.copy(file, file(file.getFileName().toString()), StandardCopyOption.REPLACE_EXISTING);
                }
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

    /** The number of texts that could be read, of those made one after the other from one source of numbers. */
    private int survivors(String name, int rounds, long seed, Function<Random, String> text) {
        var random = new Random(seed);
        int survivors = 0;
        for (int round = 0; round < rounds; round++) {
            survivors += survives(write(name, text.apply(random)), "seed " + seed + ", round " + round) ? 1 : 0;
        }
        return survivors;
    }

    private void cutOffAnywhere(String name, String whole) {
        for (int end = 0; end < whole.length(); end += Thorough.times(7, 1)) {
            survives(write(name, whole.substring(0, end)), "the first " + end + " characters");
        }
    }

    private void writeArena() {
        write("pioneer.inc", PIONEER);
        write("arena.world", ARENA);
    }

    @Test
    void file_cutOffAnywhere_isReadOrRefused() {
        writeArena();
        assertThat(survives(write("t.world", WHOLE), "the whole")).isTrue();
        cutOffAnywhere("t.world", WHOLE);
        cutOffAnywhere("t.cfg", CONFIG);
    }

    @Test
    void file_changedAtRandom_isReadOrRefused() {
        writeArena();
        assertThat(survivors("t.world", WORLDS, SEED_OF_PIECES, random -> changed(WHOLE, random)))
                .as("worlds that could still be read")
                .isBetween(WORLDS / 100, WORLDS * 99 / 100);
        assertThat(survivors("t.cfg", FILES, SEED_OF_PIECES, random -> changed(CONFIG, random)))
                .as("configurations that could still be read")
                .isBetween(FILES / 100, FILES * 99 / 100);
    }

    private static String changed(String whole, Random random) {
        var text = new StringBuilder(whole);
        int changes = 1 + random.nextInt(3);
        for (int i = 0; i < changes; i++) {
            change(text, random);
        }
        return text.toString();
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

    @Test
    void shippedWorlds_changedAtRandom_areReadOrRefused() throws IOException {
        List<Path> files = new ArrayList<>();
        try (Stream<Path> all = Files.list(dir)) {
            all.filter(file -> file.toString().matches(".*\\.(world|cfg|inc)"))
                    .sorted()
                    .forEach(files::add);
        }
        files.add(write("crowd.world", CrowdWorld.text(3)));
        files.add(write("newer.world", """
                define pioneer position ( size [ 0.4 0.4 0.2 ] velocity_bounds [ -0.5 0.5 0 0 0 0 -90 90 ]
                  ranger ( sensor ( pose [ 0.1 0 0 0 ] range [ 0 5 ] fov 15 samples 1 noise [ 0 0.01 0 ] ) sensor () ) )
                pioneer ( name "a" localization "odom" odom_error [ 0.1 0.1 0 0.1 ] model ( size [ 0.1 0.1 ] ) )
                """));
        var random = new Random(SEED);
        int survivors = 0;
        int rounds = 0;
        for (Path file : files) {
            String whole = text(file);
            for (int round = 0; round < Thorough.times(6, 60); round++) {
                Files.writeString(file, damaged(whole, random));
                // an include file is read through the world that uses it
                Path asked = file.toString().endsWith(".inc") ? file("office.world") : file;
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
        assertThat(survivors("t.world", FILES, SEED, random -> {
                    var text = new StringBuilder();
                    for (int words = random.nextInt(40); words >= 0; words--) {
                        text.append(WORDS[random.nextInt(WORDS.length)]).append(' ');
                    }
                    return text.toString();
                }))
                .as("files that could be read")
                .isBetween(Thorough.times(0, 1), FILES / 2);
    }

    @Test
    void properties_inEntities_areReadOrRefused() {
        assertThat(survivors("t.world", FILES, SEED, random -> {
                    var text = new StringBuilder();
                    entity(text, random, 0);
                    return text.toString();
                }))
                .as("files that could be read")
                .isBetween(FILES / 100, FILES * 99 / 100);
    }

    /** An entity with properties, most of the right kind. */
    private static void entity(StringBuilder text, Random random, int depth) {
        String[] types = {"model", "position", "ranger", "laser", "blobfinder", "sensor", "gripper"};
        text.append(types[depth == 0 ? random.nextInt(2) : random.nextInt(types.length)])
                .append(" ( ");
        for (int i = random.nextInt(4); i > 0; i--) {
            text.append(PROPERTIES[random.nextInt(PROPERTIES.length)]).append(' ');
        }
        for (int i = depth < 4 ? random.nextInt(3) : 0; i > 0; i--) {
            entity(text, random, depth + 1);
        }
        text.append(") ");
    }

    @Test
    void image_changedAtRandom_isReadOrRefused() throws IOException {
        byte[] whole = Files.readAllBytes(file("cave.png"));
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < IMAGES; round++) {
            byte[] damaged = whole.clone();
            for (int changes = 1 + random.nextInt(3); changes > 0; changes--) {
                // half of the changes hit the header
                damaged[random.nextInt(random.nextBoolean() ? 60 : damaged.length)] = (byte) random.nextInt(256);
            }
            Files.write(file("cave.png"), damaged);
            survivors += survives(file("cave.world"), "seed " + SEED + ", round " + round) ? 1 : 0;
        }
        assertThat(survivors).as("images that could be read").isBetween(Thorough.times(0, 1), IMAGES - 1);
    }

    @ParameterizedTest
    @ValueSource(strings = {"P1 4 2 1 0 0 1 1 1 1 1 ", "P2 4 2 15 0 15 7 0 1 2 3 4 ", "P5 4 2 255\nabcdefgh"})
    void netpbmImage_changedAtRandom_isReadOrRefused(String image) throws IOException {
        byte[] whole = image.getBytes(StandardCharsets.ISO_8859_1);
        Path world = file("pnm.world");
        Files.writeString(world, "model ( bitmap \"t.pgm\" size [ 4 2 1 ] )");
        var random = new Random(SEED);
        int survivors = 0;
        for (int round = 0; round < IMAGES; round++) {
            byte[] damaged = Arrays.copyOf(whole, whole.length - random.nextInt(2));
            damaged[random.nextInt(damaged.length)] = (byte) (random.nextBoolean() ? random.nextInt(256) : '9');
            Files.write(file("t.pgm"), damaged);
            survivors += survives(world, "seed " + SEED + ", round " + round) ? 1 : 0;
        }
        assertThat(survivors).as("images that could be read").isBetween(1, IMAGES - 1);
    }
}
