package io.troupe.paper;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/**
 * The lines that the paper prints are in the programs, in their order; the guide lists those that are not. White space
 * is ignored, because the formatter decides it.
 */
class PrintedFiguresTest {
    private static final String FIGURE_7 = """
            PlayerClient robot = null;
            Position2DInterface posi1 = null;
            SonarInterface rngi1 = null;
            BlobfinderInterface blfi1 = null;

            try {
                // Connect to the Player server and request access to Position and Sonar
                robot = new PlayerClient ("localhost", 6665);
                posi1 = robot.requestInterfacePosition2D (0, PlayerConstants.PLAYER_OPEN_MODE);
                rngi1 = robot.requestInterfaceSonar (0, PlayerConstants.PLAYER_OPEN_MODE);
                blfi1 = robot.requestInterfaceBlobfinder (0, PlayerConstants.PLAYER_OPEN_MODE);
            } catch (PlayerException e) {
                System.err.println ("robot1: > Error connecting to Player: ");
                System.err.println ("    [ " + e.toString() + " ]");
                System.exit (1);
            }

            robot.runThreaded (-1, -1);
            """;

    private static final String FIGURE_14 = """
            if(color1 == 255){
                System.out.println("State 1");
                do{
                    wallF(posi1, rngi1, blfi1);
                    color4 = SW( posi, rngi, blfi);
                    System.out.println(color4);
                    if(color4 !=0 && color4 != 16753920){
                        color1 = color4;
                    }
                }
            }
            """;

    private static final String FIGURE_17 = """
            if (color2==255){
                System.out.println("State 1");
                while(!(atomicRefSW2.get()==2));
                atomicRefWF1.set(1);

                atomicRefSW2.set(1);
                atomicRefBF2.set(1);
                robot2.spaceWanderer((ch,err) -> {
                    color2 = (int) ch;
                    System.out.println(color2);
                    System.out.println("received color "+System.currentTimeMillis());
                    if(color2!=255 && color2!=16753920){
                        atomicRefWF1.set(0);
                        atomicRefSW2.set(0);
                        atomicRefBF2.set(0);
                        ((Demo2) self()).live();
                    }
                },1, atomicRefSW2,atomicRefBF2);
                robot1.wallFollower(0, atomicRefWF1);
            }
            """;

    private static final String FIGURE_20 = """
            if (color2==255){
                System.out.println("State 1");
                atomicRefWF1.set(1);
                robot1.wallFollower(0, atomicRefWF1);
                atomicRefSW2.set(1);
                atomicRefBF2.set(1);
                robot2.spaceWanderer(1,atomicRefSW2,atomicRefBF2, 255).then(result-> {
                    color2 = result;
                    System.out.println("color"+color2);

                    atomicRefSW2.set(0);
                    atomicRefBF2.set(0);
                    ((Demo3) self()).live();
                });
            }
            """;

    /** The printed lines that a program does not have. */
    private static List<String> missing(String figure, Class<?> program) throws IOException {
        String source = Files.readString(Path.of("src/main/java/io/troupe/paper", program.getSimpleName() + ".java"));
        return missing(figure, source);
    }

    private static List<String> missing(String figure, String source) {
        String code = essence(source);
        List<String> missing = new ArrayList<>();
        int end = 0;
        for (String line : figure.lines().toList()) {
            String printed = essence(line);
            int at = code.indexOf(printed, end);
            if (at < 0) {
                missing.add(line.strip());
            } else {
                end = at + printed.length();
            }
        }
        return missing;
    }

    private static String essence(String code) {
        return code.replaceAll("(?m)//.*$", "").replaceAll("\\s", "");
    }

    @Test
    void programs_haveEveryPrintedLine_butTwo() throws IOException {
        assertThat(missing(FIGURE_7, Figure7.class)).containsExactly("robot = new PlayerClient (\"localhost\", 6665);");
        assertThat(missing(FIGURE_14, Demo1.class)).isEmpty();
        assertThat(missing(FIGURE_17, Demo2.class)).containsExactly("while(!(atomicRefSW2.get()==2));");
        assertThat(missing(FIGURE_20, Demo3.class)).isEmpty();
    }

    @Test
    void lineThatIsLeftOutOrInAnotherPlace_isMissing() {
        assertThat(missing("a();\nb( 1 );\nc();", "a(); // b(1);\nc();")).containsExactly("b( 1 );");
        assertThat(missing("a();\nb();", "b();\n a();")).containsExactly("b();");
    }
}
