#if NETSTANDARD2_1
namespace System.Diagnostics.CodeAnalysis;

/// <summary>Suppresses a warning of the trimmer, which heeds it by name: .NET 5 and later know it.</summary>
[AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
internal sealed class UnconditionalSuppressMessageAttribute(string category, string checkId) : Attribute
{
    public string Category { get; } = category;

    public string CheckId { get; } = checkId;

    public string? Justification { get; set; }
}
#endif
