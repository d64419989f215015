package io.troupe.actor;

import static org.objectweb.asm.Opcodes.*;

import java.lang.reflect.Method;
import org.objectweb.asm.ClassWriter;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Type;

/**
 * Generates the methods of a proxy that send no message: bridges, methods that throw, {@code toString}, {@code equals}
 * and {@code hashCode}.
 */
final class LocalMethods {
    private static final String CELL_TYPE = Type.getInternalName(ActorCell.class);

    private final Class<?> type;
    private final String proxyName;
    private final ActorMethods methods;

    LocalMethods(Class<?> type, String proxyName, ActorMethods methods) {
        this.type = type;
        this.proxyName = proxyName;
        this.methods = methods;
    }

    void write(ClassWriter writer) {
        methods.bridges().forEach(bridge -> bridge(writer, bridge.from(), bridge.to()));
        for (Method method : methods.refused()) {
            refuse(
                    writer,
                    method.getModifiers() & (ACC_PUBLIC | ACC_PROTECTED),
                    method.getName(),
                    Type.getMethodDescriptor(method),
                    ActorMethods.show(method)
                            + " was called on a proxy, and is no message because it is not public: make it public, or call it inside the actor");
        }
        nameAsText(writer);
        if (!type.isInterface()) {
            lifecycle(writer, "started");
            lifecycle(writer, "stopped");
            identity(writer);
        }
    }

    private void bridge(ClassWriter writer, Method from, Method to) {
        MethodVisitor code = writer.visitMethod(
                ACC_PUBLIC | ACC_BRIDGE | ACC_SYNTHETIC, from.getName(), Type.getMethodDescriptor(from), null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        Type[] given = Type.getArgumentTypes(from);
        Type[] wanted = Type.getArgumentTypes(to);
        int local = 1;
        for (int index = 0; index < given.length; index++) {
            code.visitVarInsn(given[index].getOpcode(ILOAD), local);
            if (!wanted[index].equals(given[index])) {
                code.visitTypeInsn(CHECKCAST, wanted[index].getInternalName());
            }
            local += given[index].getSize();
        }
        code.visitMethodInsn(INVOKEVIRTUAL, proxyName, to.getName(), Type.getMethodDescriptor(to), false);
        code.visitInsn(Type.getReturnType(from).getOpcode(IRETURN));
        finish(code);
    }

    private void lifecycle(ClassWriter writer, String name) {
        String text = type.getSimpleName() + "." + name
                + "() was called on a proxy, and is no message: the actor's space calls it";
        refuse(writer, ACC_PUBLIC, name, "()V", text);
    }

    private static void refuse(ClassWriter writer, int access, String name, String descriptor, String text) {
        MethodVisitor code = writer.visitMethod(access, name, descriptor, null, null);
        code.visitCode();
        code.visitTypeInsn(NEW, "java/lang/IllegalStateException");
        code.visitInsn(DUP);
        code.visitLdcInsn(text);
        code.visitMethodInsn(
                INVOKESPECIAL, "java/lang/IllegalStateException", "<init>", "(Ljava/lang/String;)V", false);
        code.visitInsn(ATHROW);
        finish(code);
    }

    private void nameAsText(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(ACC_PUBLIC, "toString", "()Ljava/lang/String;", null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitFieldInsn(GETFIELD, proxyName, ProxyGenerator.CELL, Type.getDescriptor(ActorCell.class));
        code.visitMethodInsn(INVOKEVIRTUAL, CELL_TYPE, "toString", "()Ljava/lang/String;", false);
        code.visitInsn(ARETURN);
        finish(code);
    }

    /** A class actor's own equals and hashCode would read fields that are unset in a proxy. */
    private static void identity(ClassWriter writer) {
        MethodVisitor hash = writer.visitMethod(ACC_PUBLIC, "hashCode", "()I", null, null);
        hash.visitCode();
        hash.visitVarInsn(ALOAD, 0);
        hash.visitMethodInsn(INVOKESTATIC, "java/lang/System", "identityHashCode", "(Ljava/lang/Object;)I", false);
        hash.visitInsn(IRETURN);
        finish(hash);
        MethodVisitor equals = writer.visitMethod(ACC_PUBLIC, "equals", "(Ljava/lang/Object;)Z", null, null);
        equals.visitCode();
        equals.visitVarInsn(ALOAD, 0);
        equals.visitVarInsn(ALOAD, 1);
        equals.visitMethodInsn(
                INVOKESTATIC,
                Type.getInternalName(ActorCell.class),
                "same",
                "(Ljava/lang/Object;Ljava/lang/Object;)Z",
                false);
        equals.visitInsn(IRETURN);
        finish(equals);
    }

    private static void finish(MethodVisitor code) {
        code.visitMaxs(0, 0);
        code.visitEnd();
    }
}
