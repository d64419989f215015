package io.troupe.common.text;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class NamedColoursTest {
    @Test
    void coloursOfThePaper_areThoseOfX11() {
        assertThat(NamedColours.byName())
                .hasSize(677)
                .containsAllEntriesOf(Map.of("blue", NamedColours.BLUE, "red", NamedColours.RED))
                .containsAllEntriesOf(Map.of("green", NamedColours.GREEN, "orange", NamedColours.ORANGE))
                .containsEntry("black", NamedColours.BLACK);
        assertThat(NamedColours.names())
                .startsWith("blue", "red", "green", "orange", "black")
                .doesNotHaveDuplicates()
                .isSubsetOf(NamedColours.byName().keySet());
        assertThat(NamedColours.byName().values()).allMatch(colour -> colour >= 0 && colour <= NamedColours.LAST);
    }

    @ParameterizedTest
    @CsvSource({
        "purple, a020f0", "violet, ee82ee", "brown, a52a2a", "gold, ffd700", "navy, 000080", "turquoise, 40e0d0",
        "maroon, b03060", "indigo, 4b0082", "olive, 808000", "teal, 008080", "silver, c0c0c0", "white, ffffff"
    })
    void nameOfATable_isThatOfItsColour(String name, String hex) {
        int colour = Integer.parseInt(hex, 16);
        assertThat(NamedColours.named(name)).hasValue(colour);
        assertThat(NamedColours.name(colour)).isEqualTo(name);
    }

    @Test
    void name_ignoresCase_inX11AlsoSpaces_andOfTwoNamesTheFirstCounts() {
        assertThat(NamedColours.named("GRAY")).hasValue(0xBEBEBE);
        assertThat(NamedColours.name(0xBEBEBE)).isEqualTo("grey");
        assertThat(NamedColours.named("salmon")).isEmpty();
        assertThat(NamedColours.name(0xFA8072)).isEqualTo("#FA8072");
        assertThat(NamedColours.namedInX11("Light Sea Green")).hasValue(0x20B2AA);
        assertThat(NamedColours.namedInX11("RebeccaPurple")).hasValue(0x663399);
        assertThat(NamedColours.namedInX11("gren")).isEmpty();
    }
}
