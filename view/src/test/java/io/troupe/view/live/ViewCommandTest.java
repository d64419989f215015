package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.tools.Thorough;
import io.troupe.view.live.ViewCommand.Intervention;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.Collectors;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ViewCommandTest {
    private static final List<String> WORDS = List.of(
            "pause",
            "resume",
            "step",
            "speed",
            "reset",
            "place",
            "drive",
            "release",
            "box",
            "unbox",
            "ff0000",
            "1",
            "2",
            "0",
            "-1",
            "99999999999",
            "1e3",
            "1e999",
            "NaN",
            "Infinity",
            "0x1p3",
            "1.",
            ".5",
            "-0.0",
            "",
            "\u0000",
            "\n",
            "é",
            "1_0",
            "+1",
            "1d");

    @Test
    void words_areReadAsTheSameCommand() {
        List<Intervention> all = List.of(
                new ViewCommand.Reset(),
                new ViewCommand.Place(1, new Pose(0.1, -2.5e-7, 3.0)),
                new ViewCommand.Drive(0, 0.25, -1),
                new ViewCommand.Release(1),
                new ViewCommand.PutBox(new ColouredBox(20, 0x00FF7F, 0.1, -2.5e-7)),
                new ViewCommand.RemoveBox(3));
        assertThat(all)
                .allSatisfy(
                        each -> assertThat(ViewCommand.parse(each.words(), 2)).isEqualTo(each));
        assertThat(ViewCommand.parse("  speed   2.5 ", 2)).isEqualTo(new ViewCommand.Speed(2.5));
        assertThat(ViewCommand.parse("step", 2)).isEqualTo(new ViewCommand.Step());
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "jump           | 'jump' is no command",
                "``             | '' is no command",
                "pause now      | 'pause' has 1 words after it, expected 0",
                "place 1 2 3    | 'place' has 3 words after it, expected 4",
                "place 0 1 1 1  | robot '0', expected a number from 1 to 2",
                "release 3      | robot '3', expected a number from 1 to 2",
                "drive 1 NaN 0  | 'NaN', expected a number",
                "drive 1 1e9 0  | '1e9', expected a number of at most 1000000",
                "box 1 ff0000 1 | 'box' has 3 words after it, expected 4",
                "box 1 red 1 1  | colour 'red', expected six hexadecimal digits",
                "box 21 0000ff 1 1 | box '21', expected a number from 1 to 20",
                "unbox 0        | box '0', expected a number from 1 to 20",
                "speed -1       | the speed is -1, expected 0 or more",
            })
    void wrongWords_areNamed(String line, String message) {
        assertThatThrownBy(() -> ViewCommand.parse(line, 2))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(message);
    }

    @Test
    void anyLine_isACommandOfTheWorld_orRefused() {
        long seed = 20_260;
        var random = new SplittableRandom(seed);
        int understood = 0;
        for (int round = 0; round < Thorough.times(5_000, 50_000); round++) {
            String line = random.ints(random.nextInt(6), 0, WORDS.size())
                    .mapToObj(WORDS::get)
                    .collect(Collectors.joining(random.nextInt(10) == 0 ? "" : " "));
            try {
                ViewCommand command = ViewCommand.parse(line, 2);
                understood++;
                if (command instanceof Intervention intervention) {
                    assertThat(ViewCommand.parse(intervention.words(), 2))
                            .as("seed %d", seed)
                            .isEqualTo(command);
                }
            } catch (IllegalArgumentException refused) {
                assertThat(refused).as("seed %d, line '%s'", seed, line).hasMessageContaining("expected");
            }
        }
        assertThat(understood).as("lines that were commands").isGreaterThan(Thorough.times(10, 100));
    }
}
