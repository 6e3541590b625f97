using System;
using System.Collections.Generic;
using System.Collections.Immutable;
using System.IO;
using System.Reflection;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;

namespace LagSim.Build;

/// <summary>The members of an assembly by their identity in XML documentation, such as <c>M:LagSim.Simulation.AdvanceTo(LagSim.Time.SimTime)</c>.</summary>
/// <remarks>Read from its metadata, without loading it: it may be of another framework.</remarks>
internal sealed class DocumentedMembers
{
    private readonly Dictionary<string, bool> all = new(StringComparer.Ordinal);
    private readonly MetadataReader reader;

    private DocumentedMembers(MetadataReader reader) => this.reader = reader;

    /// <summary>All members, and whether others can use them: public ones, and those that derived types see, of types like that.</summary>
    internal static IReadOnlyDictionary<string, bool> Of(string assembly)
    {
        using PEReader file = new(File.OpenRead(assembly));
        DocumentedMembers members = new(file.GetMetadataReader());
        foreach (TypeDefinitionHandle type in members.reader.TypeDefinitions)
        {
            members.Add(type);
        }

        return members.all;
    }

    private void Add(TypeDefinitionHandle handle)
    {
        TypeDefinition type = reader.GetTypeDefinition(handle);
        string name = DocumentedTypes.NameOf(reader, handle);
        bool isVisible = IsVisible(type);
        all[$"T:{name}"] = isVisible;
        foreach (FieldDefinitionHandle one in type.GetFields())
        {
            FieldDefinition field = reader.GetFieldDefinition(one);
            all[$"F:{name}.{Name(field.Name)}"] = isVisible && IsVisible((MethodAttributes)field.Attributes);
        }

        foreach (MethodDefinitionHandle one in type.GetMethods())
        {
            MethodDefinition method = reader.GetMethodDefinition(one);
            MethodSignature<string> signature = method.DecodeSignature(DocumentedTypes.Instance, null);
            string of = signature.GenericParameterCount > 0 ? $"``{signature.GenericParameterCount}" : "";
            string to = Name(method.Name) is "op_Implicit" or "op_Explicit" ? $"~{signature.ReturnType}" : "";
            all[$"M:{name}.{Name(method.Name)}{of}{List(signature.ParameterTypes)}{to}"] = isVisible && IsVisible(method.Attributes);
        }

        foreach (PropertyDefinitionHandle one in type.GetProperties())
        {
            PropertyDefinition property = reader.GetPropertyDefinition(one);
            PropertyAccessors accessors = property.GetAccessors();
            string of = List(property.DecodeSignature(DocumentedTypes.Instance, null).ParameterTypes);
            all[$"P:{name}.{Name(property.Name)}{of}"] = isVisible && (IsVisible(accessors.Getter) || IsVisible(accessors.Setter));
        }

        foreach (EventDefinitionHandle one in type.GetEvents())
        {
            EventDefinition raised = reader.GetEventDefinition(one);
            all[$"E:{name}.{Name(raised.Name)}"] = isVisible && IsVisible(raised.GetAccessors().Adder);
        }
    }

    // Of a member's name the points are written in another way, since points part it from its type: of constructors and explicit implementations.
    private string Name(StringHandle name) =>
        reader.GetString(name).Replace('.', '#').Replace('<', '{').Replace('>', '}').Replace(',', '@');

    private static string List(ImmutableArray<string> types) => types.IsEmpty ? "" : $"({string.Join(',', types)})";

    private bool IsVisible(TypeDefinition type)
    {
        TypeAttributes visibility = type.Attributes & TypeAttributes.VisibilityMask;
        return visibility is TypeAttributes.Public || (
            visibility is TypeAttributes.NestedPublic or TypeAttributes.NestedFamily or TypeAttributes.NestedFamORAssem
            && IsVisible(reader.GetTypeDefinition(type.GetDeclaringType())));
    }

    private bool IsVisible(MethodDefinitionHandle accessor) => !accessor.IsNil && IsVisible(reader.GetMethodDefinition(accessor).Attributes);

    // Fields have the same bits.
    private static bool IsVisible(MethodAttributes member) =>
        (member & MethodAttributes.MemberAccessMask) is MethodAttributes.Public or MethodAttributes.Family or MethodAttributes.FamORAssem;
}
