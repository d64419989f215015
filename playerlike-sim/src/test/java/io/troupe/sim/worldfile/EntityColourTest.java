package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class EntityColourTest {
    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    private int colourOf(String properties) {
        return worlds.world("define base model ( color \"green\" ) base ( " + properties + " )")
                .obstacles()
                .getFirst()
                .colour();
    }

    @ParameterizedTest
    @CsvSource({
        "blue,0000ff",
        "red,ff0000",
        "green,00ff00",
        "orange,ffa500",
        "black,000000",
        "gray30,4d4d4d",
        "Light Sea Green,20b2aa",
        "lightSeaGreen,20b2aa",
        "RebeccaPurple,663399",
        "crimson,dc143c",
        "gray,bebebe"
    })
    void colour_byName_isThatOfX11(String name, String hex) {
        assertThat(colourOf("color \"" + name + '"')).isEqualTo(Integer.parseInt(hex, 16));
    }

    @Test
    void colour_mixed_roundsToBytesAndIgnoresAlpha() {
        assertThat(colourOf("color_rgba [ 1 0.5 0 0.3 ]")).isEqualTo(0xff8000);
    }

    @Test
    void colour_notGiven_isRedOrTheMacros() {
        assertThat(worlds.world("model ()").obstacles().getFirst().colour()).isEqualTo(0xff0000);
        assertThat(colourOf("")).isEqualTo(0x00ff00);
    }

    @Test
    void colour_ofAnInstance_winsOverBothFormsInTheMacro() {
        String macro = "define both model ( color \"green\" color_rgba [ 0 0 1 1 ] ) ";

        assertThat(worlds.world(macro + "both ()").obstacles().getFirst().colour())
                .isEqualTo(0x0000ff);
        assertThat(worlds.world(macro + "both ( color \"red\" )")
                        .obstacles()
                        .getFirst()
                        .colour())
                .isEqualTo(0xff0000);
    }

    @Test
    void colour_unknown_suggestsTheNearest() {
        assertThat(worlds.problem("model ( color \"gren\" )"))
                .isEqualTo("t.world:1:15: unknown colour \"gren\"; did you mean \"green\"?");
        assertThat(worlds.problem("model ( color \"#00ff00\" )"))
                .isEqualTo("t.world:1:15: unknown colour \"#00ff00\"; expected a colour name of X11, such as \"red\"");
        assertThat(worlds.problem("model ( color_rgba [ 255 0 0 1 ] )"))
                .isEqualTo("t.world:1:20: \"color_rgba\" must be four shares from 0 to 1, not 255.0");
    }
}
