package io.troupe.checks.api;

import com.sun.source.tree.ClassTree;
import com.sun.source.tree.CompilationUnitTree;
import com.sun.source.util.DocTrees;
import com.sun.source.util.JavacTask;
import com.sun.source.util.TreePath;
import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import javax.lang.model.element.Modifier;
import javax.tools.ToolProvider;

/** Reads the public top-level types of a source folder, with their Javadoc, by the compiler's own parser. */
public final class PublicTypes {
    /**
     * A public top-level type.
     *
     * @param name the qualified name
     * @param javadoc the text of its comment in one line; empty if it has none
     */
    public record PublicType(String name, String javadoc) {
        /** True if it is public for technical reasons only: it is in a package called {@code internal}, or below. */
        public boolean isForTheLibraryOnly() {
            return name.contains(".internal.");
        }
    }

    private PublicTypes() {}

    public static List<PublicType> in(Path folder) throws IOException {
        var compiler = Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE, runs the tests");
        List<PublicType> types = new ArrayList<>();
        try (var files = compiler.getStandardFileManager(null, null, null)) {
            var task = (JavacTask) compiler.getTask(
                    null,
                    files,
                    null,
                    List.of("-proc:none"),
                    null,
                    files.getJavaFileObjectsFromPaths(Repository.files(folder, ".java")));
            var docs = DocTrees.instance(task);
            for (CompilationUnitTree unit : task.parse()) {
                for (var declaration : unit.getTypeDecls()) {
                    if (declaration instanceof ClassTree type
                            && type.getModifiers().getFlags().contains(Modifier.PUBLIC)) {
                        String comment = docs.getDocComment(TreePath.getPath(unit, type));
                        types.add(new PublicType(
                                unit.getPackageName() + "." + type.getSimpleName(),
                                comment == null ? "" : comment.strip().replaceAll("\\s+", " ")));
                    }
                }
            }
        }
        return types;
    }
}
