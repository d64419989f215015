package io.troupe.checks.architecture;

import static com.tngtech.archunit.base.DescribedPredicate.describe;

import com.tngtech.archunit.core.domain.JavaClasses;
import com.tngtech.archunit.core.importer.ClassFileImporter;
import io.troupe.checks.Repository;
import java.nio.file.Files;
import java.util.function.Predicate;
import java.util.stream.Stream;

/**
 * The compiled main classes of the modules, read from the folders of the build that runs this test.
 *
 * <p><b>Role.</b> It reads folders, not the class path. So the module of each class is known, and a module that is not
 * on the class path of {@code checks} is included too.
 */
final class Classes {
    private static final boolean COMPILED_BY_MAVEN = Classes.class
            .getProtectionDomain()
            .getCodeSource()
            .getLocation()
            .getPath()
            .matches(".*/target/test-classes/?");

    /** Every module but {@code stress}, whose tests are in the packages that they test. */
    static final JavaClasses MAIN = read(module -> !module.equals("stress"));

    static final JavaClasses STRESS = read("stress"::equals);

    private Classes() {}

    static JavaClasses of(String module) {
        String folder = "/" + module + (COMPILED_BY_MAVEN ? "/target/" : "/build/");
        return (module.equals("stress") ? STRESS : MAIN)
                .that(describe(
                        "are in " + module,
                        each -> each.getSource().stream()
                                .anyMatch(source -> source.getUri().getPath().contains(folder))));
    }

    private static JavaClasses read(Predicate<String> wanted) {
        var folders = Repository.modules().stream()
                .filter(module -> wanted.test(module.getFileName().toString()))
                .flatMap(module -> COMPILED_BY_MAVEN
                        ? Stream.of(module.resolve("target/classes"))
                        : Stream.of("java", "kotlin").map(each -> module.resolve("build/classes/" + each + "/main")))
                .filter(Files::isDirectory)
                .toList();
        return new ClassFileImporter()
                .withImportOption(location -> !location.contains("jmh_generated"))
                .importPaths(folders);
    }
}
