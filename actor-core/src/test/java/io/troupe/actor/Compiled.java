package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.IOException;
import java.io.StringWriter;
import java.net.URI;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import javax.tools.JavaCompiler;
import javax.tools.JavaFileObject;
import javax.tools.SimpleJavaFileObject;
import javax.tools.ToolProvider;

/** Java sources that a test compiles at run time, because the test's own module or package does not suit. */
final class Compiled {
    private final List<JavaFileObject> sources = new ArrayList<>();
    private final Path classes;

    Compiled(Path classes) {
        this.classes = classes;
    }

    Path classes() {
        return classes;
    }

    Compiled add(String className, String source) {
        sources.add(
                new SimpleJavaFileObject(
                        URI.create("string:///" + className.replace('.', '/') + ".java"), JavaFileObject.Kind.SOURCE) {
                    @Override
                    public CharSequence getCharContent(boolean ignoreEncodingErrors) {
                        return source;
                    }
                });
        return this;
    }

    /** Compiles, against the test's class path unless the options set another one. */
    void compile(String... options) throws IOException {
        Files.createDirectories(classes);
        JavaCompiler compiler = ToolProvider.getSystemJavaCompiler();
        assumeTrue(compiler != null, "a runtime without a compiler");
        var arguments = new ArrayList<>(List.of("-d", classes.toString(), "-parameters", "-proc:none"));
        arguments.addAll(options.length > 0 ? List.of(options) : List.of("-cp", System.getProperty("java.class.path")));
        var output = new StringWriter();
        boolean done =
                compiler.getTask(output, null, null, arguments, null, sources).call();
        assertThat(done).as("the compiler says: %s", output).isTrue();
    }

    /** Compiles, and loads the classes in a child of the test's class loader. */
    URLClassLoader load() throws IOException {
        compile();
        return new URLClassLoader(new URL[] {classes.toUri().toURL()}, Compiled.class.getClassLoader());
    }
}
