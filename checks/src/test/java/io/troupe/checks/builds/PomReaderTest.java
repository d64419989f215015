package io.troupe.checks.builds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class PomReaderTest {
    private static final String ROOT = """
            <project>
              <groupId>g</groupId><artifactId>root</artifactId><version>1</version>
              <properties><maven.compiler.release>21</maven.compiler.release><asm.version>9.9</asm.version></properties>
              <dependencies>
                <dependency><groupId>t</groupId><artifactId>junit</artifactId><version>5</version><scope>test</scope></dependency>
              </dependencies>
            </project>
            """;
    private static final String HEAD = "<artifactId>troupe-core</artifactId>"
            + "<parent><groupId>g</groupId><artifactId>root</artifactId><version>1</version></parent>";

    @Test
    void module_isReadWhole() {
        var module = read("""
                <description>Actors</description>
                <properties><module.name>a.b</module.name></properties>
                <dependencies>
                  <dependency><groupId>${project.groupId}</groupId><artifactId>sim</artifactId><version>${project.version}</version></dependency>
                </dependencies>
                <build><plugins><plugin><configuration><annotationProcessorPaths>
                  <path><groupId>org.ow2.asm</groupId><artifactId>asm</artifactId><version>${asm.version}</version></path>
                </annotationProcessorPaths></configuration></plugin></plugins></build>
                """);
        assertThat(module)
                .extracting(Module::description, Module::release, Module::automaticName)
                .containsExactly("Actors", "21", "a.b");
        assertThat(module.dependencies())
                .containsExactly(
                        new Dependency(Scope.TEST, "t:junit", "5"),
                        new Dependency(Scope.COMPILE, "g:sim", "1"),
                        new Dependency(Scope.PROCESSOR, "org.ow2.asm:asm", "9.9"));
    }

    @Test
    void exclusions_areRead() {
        var module = read("<dependencies><dependency><groupId>a</groupId><artifactId>b</artifactId><version>2</version>"
                + "<exclusions><exclusion><groupId>c</groupId><artifactId>d</artifactId></exclusion></exclusions>"
                + "</dependency></dependencies>");
        assertThat(module.dependencies().getLast()).hasToString("compile a:b:2 without [c:d]");
    }

    /** As for users of the module: the property has the value from outside of the profiles. */
    @Test
    void scope_thatIsAProperty_isRead() {
        var module = read("<properties><inner>runtime</inner></properties>"
                + "<profiles><profile><properties><inner>compile</inner></properties></profile></profiles>"
                + "<dependencies><dependency><groupId>a</groupId><artifactId>b</artifactId><version>2</version>"
                + "<scope>${inner}</scope></dependency></dependencies>");
        assertThat(module.dependencies().getLast()).hasToString("runtime a:b:2");
    }

    @Test
    void module_withItsOwnReleaseLevel_hasIt() {
        var module = read("<properties><maven.compiler.release>17</maven.compiler.release></properties>");
        assertThat(module.release()).isEqualTo("17");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "<dependencyManagement/> | core/pom.xml: <dependencyManagement> is not understood",
                "<dependencies><dependency><groupId>a</groupId><optional>true</optional></dependency></dependencies> | <optional> in a dependency",
                "<dependencies><dependency><version>${gone}</version></dependency></dependencies> | POM: no property gone",
                "<dependencies><dependency><scope>system</scope></dependency></dependencies> | scope system is not understood",
                "<build><x><release>17</release></x></build> | core/pom.xml: <release> is not understood",
                "<profiles><profile><dependencies/></profile></profiles> | core/pom.xml: <dependencies> in a profile"
            })
    void element_thatIsNotUnderstood_isRefused(String element, String message) {
        assertThatThrownBy(() -> read(element))
                .isInstanceOf(BuildFileException.class)
                .hasMessageContaining(message);
    }

    @Test
    void module_withAnotherParentVersion_isRefused() {
        var pom = "<project>" + HEAD.replace("<version>1<", "<version>2<") + "</project>";
        assertThatThrownBy(() -> PomReader.module(ROOT, "core", pom))
                .hasMessage("core/pom.xml: parent's version is 2, expected 1");
    }

    private static Module read(String elements) {
        return PomReader.module(ROOT, "core", "<project>" + HEAD + elements + "</project>");
    }
}
