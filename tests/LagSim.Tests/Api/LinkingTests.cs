using System;
using System.Collections.Immutable;
using System.IO;
using System.Linq;
using System.Reflection.Metadata;
using System.Reflection.PortableExecutable;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>
/// The libraries ask for nothing that Mono as Debian builds it cannot link. Its class library was compiled by a compiler that leaves out the mark by which
/// <c>ref readonly</c> results are told, so what asks for them with the mark, as the language demands, is told that they are missing: above all the
/// indexer of a read-only span, and with it every <c>foreach</c> over one.
/// </summary>
public sealed class LinkingTests
{
    [Fact]
    public void Libraries_OfTheClassLibrary_UseNothingThatReturnsAReadOnlyReference()
    {
        Assert.Empty(ReadOnlyReferences(typeof(Simulation).Assembly.Location));
        Assert.Empty(ReadOnlyReferences(typeof(Session).Assembly.Location));
    }

    [Fact]
    public void ReadOnlyReferences_OfCodeThatUsesThem_AreFound()
    {
        ReadOnlySpan<byte> bytes = [1, 2, 3];
        int sum = 0;
        foreach (byte next in bytes)
        {
            sum += next;
        }

        Assert.Equal(6, sum);
        Assert.Contains("ReadOnlySpan`1.get_Item", ReadOnlyReferences(typeof(LinkingTests).Assembly.Location));
    }

    /// <summary>The members of other assemblies that a library uses and whose result is <c>ref readonly</c>.</summary>
    private static string[] ReadOnlyReferences(string path)
    {
        using PEReader file = new(File.OpenRead(path));
        MetadataReader metadata = file.GetMetadataReader();
        Names names = new();
        return metadata.MemberReferences.Select(metadata.GetMemberReference)
            .Where(member => member.GetKind() == MemberReferenceKind.Method && IsForeign(metadata, member.Parent)
                && member.DecodeMethodSignature(names, null).ReturnType.StartsWith("readonly ", StringComparison.Ordinal))
            .Select(member => $"{NameOf(metadata, names, member.Parent)}.{metadata.GetString(member.Name)}").Distinct().ToArray();
    }

    private static bool IsForeign(MetadataReader metadata, EntityHandle parent) =>
        parent.Kind is HandleKind.TypeReference or HandleKind.TypeSpecification && !NameOf(metadata, new Names(), parent).StartsWith("own ", StringComparison.Ordinal);

    private static string NameOf(MetadataReader metadata, Names names, EntityHandle type) => type.Kind switch
    {
        HandleKind.TypeReference => names.GetTypeFromReference(metadata, (TypeReferenceHandle)type, 0),
        HandleKind.TypeSpecification => metadata.GetTypeSpecification((TypeSpecificationHandle)type).DecodeSignature(names, null),
        _ => "",
    };

    /// <summary>Types as their names, without arguments; a reference that is marked read-only begins with <c>readonly</c>.</summary>
    private sealed class Names : ISignatureTypeProvider<string, object?>
    {
        public string GetArrayType(string elementType, ArrayShape shape) => elementType + "[,]";

        public string GetByReferenceType(string elementType) => elementType + "&";

        public string GetFunctionPointerType(MethodSignature<string> signature) => "*()";

        public string GetGenericInstantiation(string genericType, ImmutableArray<string> typeArguments) => genericType;

        public string GetGenericMethodParameter(object? genericContext, int index) => $"!!{index}";

        public string GetGenericTypeParameter(object? genericContext, int index) => $"!{index}";

        public string GetModifiedType(string modifier, string unmodifiedType, bool isRequired) =>
            isRequired && modifier == "InAttribute" ? "readonly " + unmodifiedType : unmodifiedType;

        public string GetPinnedType(string elementType) => elementType;

        public string GetPointerType(string elementType) => elementType + "*";

        public string GetPrimitiveType(PrimitiveTypeCode typeCode) => typeCode.ToString();

        public string GetSZArrayType(string elementType) => elementType + "[]";

        public string GetTypeFromDefinition(MetadataReader reader, TypeDefinitionHandle handle, byte rawTypeKind) =>
            "own " + reader.GetString(reader.GetTypeDefinition(handle).Name);

        public string GetTypeFromReference(MetadataReader reader, TypeReferenceHandle handle, byte rawTypeKind) =>
            reader.GetString(reader.GetTypeReference(handle).Name);

        public string GetTypeFromSpecification(MetadataReader reader, object? genericContext, TypeSpecificationHandle handle, byte rawTypeKind) =>
            reader.GetTypeSpecification(handle).DecodeSignature(this, genericContext);
    }
}
